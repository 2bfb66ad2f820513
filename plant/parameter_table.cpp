#include "plant/parameter_table.h"

#include <algorithm>
#include <array>

namespace feedtwin::plant {
namespace {

using P = AxisParameters;

// key, member, lowest, highest, preset, meaning
// clang-format off: a line a key
constexpr std::array keys{
    ParameterEntry{"axis.lead_m", [](P& p) -> double& { return p.axis.lead_m; }, 1e-4, 1.0, {}, "p_b, ball screw lead"},
    ParameterEntry{"axis.stroke_m", [](P& p) -> double& { return p.axis.stroke_m; }, 1e-3, 100.0, {}, "distance between the end stops"},
    ParameterEntry{"axis.stroke_centre_m", [](P& p) -> double& { return p.axis.stroke_centre_m; }, -100.0, 100.0, 0.0, "position of mid-stroke; motion starts there"},
    ParameterEntry{"axis.torque_limit_Nm", [](P& p) -> double& { return p.axis.torque_limit_Nm; }, 1e-6, 1e4, 1.9, "the drive's torque limit"},
    ParameterEntry{"axis.encoder_counts_per_rev", [](P& p) -> double& { return p.axis.encoder_counts_per_rev; }, 4.0, 1e9, 65536.0, "quadrature counts a motor revolution"},
    ParameterEntry{"axis.end_stop_stiffness_N_per_m", [](P& p) -> double& { return p.axis.end_stop_stiffness_N_per_m; }, 1e3, 1e9, 2e7, "end stop spring"},
    ParameterEntry{"axis.end_stop_damping_Ns_per_m", [](P& p) -> double& { return p.axis.end_stop_damping_Ns_per_m; }, 0.0, 1e7, 2e4, "end stop damper"},
    ParameterEntry{"axis.friction_laws_on_guide", [](P& p) -> double& { return p.axis.friction_laws_on_guide; }, 0.0, 1.0, 0.0, "1: what changes the ball screw's friction (drift, dwell, warm-up, place) changes the guide's, as on a direct drive"},
    ParameterEntry{"motor.inertia_kgm2", [](P& p) -> double& { return p.motor.inertia_kgm2; }, 1e-9, 100.0, {}, "J_M, rotor inertia"},
    ParameterEntry{"motor.damping_pos_Nms", [](P& p) -> double& { return p.motor.damping_Nms.pos; }, 0.0, 10.0, {}, "B_M, motor damping, positive direction"},
    ParameterEntry{"motor.damping_neg_Nms", [](P& p) -> double& { return p.motor.damping_Nms.neg; }, 0.0, 10.0, {}, "B_M, motor damping, negative direction"},
    ParameterEntry{"motor.coulomb_pos_N", [](P& p) -> double& { return p.motor.coulomb_N.pos; }, 0.0, 1e5, {}, "F_M, Coulomb friction as a force at the table, positive direction"},
    ParameterEntry{"motor.coulomb_neg_N", [](P& p) -> double& { return p.motor.coulomb_N.neg; }, 0.0, 1e5, {}, "F_M, Coulomb friction as a force at the table, negative direction"},
    ParameterEntry{"motor.ke0_W", [](P& p) -> double& { return p.motor.electrical_idle_W; }, 0.0, 1e5, 0.0, "k_e0 of Eq. 7"},
    ParameterEntry{"motor.ke1_pos_Ws_per_m", [](P& p) -> double& { return p.motor.electrical_linear_Ws_per_m.pos; }, -1e6, 1e6, 0.0, "k_e1 of Eq. 7, positive direction"},
    ParameterEntry{"motor.ke1_neg_Ws_per_m", [](P& p) -> double& { return p.motor.electrical_linear_Ws_per_m.neg; }, -1e6, 1e6, 0.0, "k_e1 of Eq. 7, negative direction"},
    ParameterEntry{"motor.ke2_pos_Ws2_per_m2", [](P& p) -> double& { return p.motor.electrical_quadratic_Ws2_per_m2.pos; }, 0.0, 1e7, 0.0, "k_e2 of Eq. 7, positive direction"},
    ParameterEntry{"motor.ke2_neg_Ws2_per_m2", [](P& p) -> double& { return p.motor.electrical_quadratic_Ws2_per_m2.neg; }, 0.0, 1e7, 0.0, "k_e2 of Eq. 7, negative direction"},
    ParameterEntry{"motor.rated_torque_Nm", [](P& p) -> double& { return p.motor.rated_torque_Nm; }, 1e-6, 1e4, 1.27, "full scale of relative torque commands"},
    ParameterEntry{"ball_screw.inertia_kgm2", [](P& p) -> double& { return p.ball_screw_inertia_kgm2; }, 0.0, 100.0, {}, "J_B, screw inertia"},
    ParameterEntry{"ball_screw.coulomb_pos_N", [](P& p) -> double& { return p.ball_screw.coulomb_N.pos; }, 1e-6, 1e5, {}, "F_C, Coulomb friction, positive direction"},
    ParameterEntry{"ball_screw.coulomb_neg_N", [](P& p) -> double& { return p.ball_screw.coulomb_N.neg; }, 1e-6, 1e5, {}, "F_C, Coulomb friction, negative direction"},
    ParameterEntry{"ball_screw.static_pos_N", [](P& p) -> double& { return p.ball_screw.static_N.pos; }, 1e-6, 1e5, {}, "F_S, breakaway friction, positive direction"},
    ParameterEntry{"ball_screw.static_neg_N", [](P& p) -> double& { return p.ball_screw.static_N.neg; }, 1e-6, 1e5, {}, "F_S, breakaway friction, negative direction"},
    ParameterEntry{"ball_screw.stribeck_pos_m_per_s", [](P& p) -> double& { return p.ball_screw.stribeck_m_per_s.pos; }, 1e-7, 10.0, {}, "v_S, Stribeck velocity, positive direction"},
    ParameterEntry{"ball_screw.stribeck_neg_m_per_s", [](P& p) -> double& { return p.ball_screw.stribeck_m_per_s.neg; }, 1e-7, 10.0, {}, "v_S, Stribeck velocity, negative direction"},
    ParameterEntry{"ball_screw.viscous_pos_Ns_per_m", [](P& p) -> double& { return p.ball_screw.viscous_Ns_per_m.pos; }, 0.0, 1e7, {}, "mu, viscous friction, positive direction"},
    ParameterEntry{"ball_screw.viscous_neg_Ns_per_m", [](P& p) -> double& { return p.ball_screw.viscous_Ns_per_m.neg; }, 0.0, 1e7, {}, "mu, viscous friction, negative direction"},
    ParameterEntry{"ball_screw.sigma0_N_per_m", [](P& p) -> double& { return p.ball_screw.stiffness_N_per_m; }, 1.0, 1e12, {}, "sigma_0, bristle stiffness"},
    ParameterEntry{"ball_screw.sigma1_Ns_per_m", [](P& p) -> double& { return p.ball_screw.damping_Ns_per_m; }, 0.0, 1e9, {}, "sigma_1, bristle damping"},
    ParameterEntry{"guide.mass_kg", [](P& p) -> double& { return p.guide_mass_kg; }, 1e-3, 1e5, {}, "M_L, table with the guide's blocks"},
    ParameterEntry{"guide.coulomb_pos_N", [](P& p) -> double& { return p.guide.coulomb_N.pos; }, 1e-6, 1e5, {}, "F_C, Coulomb friction, positive direction"},
    ParameterEntry{"guide.coulomb_neg_N", [](P& p) -> double& { return p.guide.coulomb_N.neg; }, 1e-6, 1e5, {}, "F_C, Coulomb friction, negative direction"},
    ParameterEntry{"guide.static_pos_N", [](P& p) -> double& { return p.guide.static_N.pos; }, 1e-6, 1e5, {}, "F_S, breakaway friction, positive direction"},
    ParameterEntry{"guide.static_neg_N", [](P& p) -> double& { return p.guide.static_N.neg; }, 1e-6, 1e5, {}, "F_S, breakaway friction, negative direction"},
    ParameterEntry{"guide.stribeck_pos_m_per_s", [](P& p) -> double& { return p.guide.stribeck_m_per_s.pos; }, 1e-7, 10.0, {}, "v_S, Stribeck velocity, positive direction"},
    ParameterEntry{"guide.stribeck_neg_m_per_s", [](P& p) -> double& { return p.guide.stribeck_m_per_s.neg; }, 1e-7, 10.0, {}, "v_S, Stribeck velocity, negative direction"},
    ParameterEntry{"guide.viscous_pos_Ns_per_m", [](P& p) -> double& { return p.guide.viscous_Ns_per_m.pos; }, 0.0, 1e7, {}, "mu, viscous friction, positive direction"},
    ParameterEntry{"guide.viscous_neg_Ns_per_m", [](P& p) -> double& { return p.guide.viscous_Ns_per_m.neg; }, 0.0, 1e7, {}, "mu, viscous friction, negative direction"},
    ParameterEntry{"guide.sigma0_N_per_m", [](P& p) -> double& { return p.guide.stiffness_N_per_m; }, 1.0, 1e12, {}, "sigma_0, bristle stiffness"},
    ParameterEntry{"guide.sigma1_Ns_per_m", [](P& p) -> double& { return p.guide.damping_Ns_per_m; }, 0.0, 1e9, {}, "sigma_1, bristle damping"},
    ParameterEntry{"power.meter_window_s", [](P& p) -> double& { return p.power_meter_window_s; }, 1e-3, 10.0, 0.1, "the power meter shows the mean of each window"},
    ParameterEntry{"power.meter_readings", [](P& p) -> double& { return p.power_meter_readings; }, 0.01, 64.0, 1.0, "readings that a window spans: windows overlap where it is more than one, and do not meet where it is less"},
};
// clang-format on

}  // namespace

std::span<const ParameterEntry> parameter_table() noexcept {
  return keys;
}

const ParameterEntry* find_parameter(std::string_view key) noexcept {
  const auto found = std::ranges::find(keys, key, &ParameterEntry::key);
  return found == keys.end() ? nullptr : &*found;
}

AxisParameters source_axis() noexcept {
  AxisParameters p;
  p.axis = {.lead_m = 0.005, .stroke_m = 0.15, .torque_limit_Nm = 1.9};
  p.motor = {.inertia_kgm2 = 4.0e-5,
             .damping_Nms = {4.8e-4, 3.3e-4},
             .coulomb_N = {36.5, 16.2},
             .electrical_idle_W = 0.25,
             .electrical_linear_Ws_per_m = {2.1, 18.1},
             .electrical_quadratic_Ws2_per_m2 = {1370.0, 1610.0}};
  p.ball_screw_inertia_kgm2 = 1.5e-5;
  p.ball_screw = {.coulomb_N = {69.8, 64.6},
                  .static_N = {82.0, 82.9},
                  .stribeck_m_per_s = {9.4e-4, 7.5e-4},
                  .viscous_Ns_per_m = {2.2e3, 2.0e3},
                  .stiffness_N_per_m = 5.08e7,
                  .damping_Ns_per_m = 7706.0};
  p.guide_mass_kg = 4.0;
  p.guide = {.coulomb_N = {5.2, 5.4},
             .static_N = {10.4, 9.1},
             .stribeck_m_per_s = {2.7e-3, 3.3e-3},
             .viscous_Ns_per_m = {59.8, 55.8},
             .stiffness_N_per_m = 5.09e5,
             .damping_Ns_per_m = 1222.0};
  return p;
}

}  // namespace feedtwin::plant
