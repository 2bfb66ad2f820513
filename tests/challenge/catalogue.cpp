#include "tests/challenge/catalogue.h"

#include <array>
#include <cmath>

namespace feedtwin::challenge {
namespace {

using Shape = std::mt19937_64;

double uniform(Shape& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

double one_of(Shape& random, std::initializer_list<double> values) {
  return values.begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
}

double sign(Shape& random) {
  return std::bernoulli_distribution(0.5)(random) ? 1.0 : -1.0;
}

Wave wave(double amplitude, Shape& shape, std::initializer_list<double> cycles) {
  return {amplitude, one_of(shape, cycles), uniform(shape, -3.1, 3.1)};
}

Numbers numbers(const char* name, const Wave& w) {
  return {{name, w.amplitude}, {"cycles_per_rev", w.cycles_per_rev}, {"phase_rad", w.phase_rad}};
}

}  // namespace

// id, needed channels, seen in torque, wants dwell, strength from, to, set, numbers, alike
const std::vector<Hidden>& catalogue() {
  static const std::vector<Hidden> all = {
      {"cogging",
       none,
       true,
       false,
       5e-4,
       0.04,
       [](Effects& e, double s, Shape r, const Reach&) { e.cogging = wave(s, r, {4, 6, 8, 12, 18, 24}); },
       [](const Effects& e) { return numbers("amplitude_Nm", e.cogging); },
       {"rev_ripple"}},
      {"torque_ripple", none, true, false, 0.005, 0.15,
       [](Effects& e, double s, Shape r, const Reach&) { e.torque_ripple = wave(s, r, {1, 2, 4, 6, 12}); },
       [](const Effects& e) { return numbers("relative_amplitude", e.torque_ripple); }},
      {"rev_ripple",
       torque_sensor,
       true,
       false,
       0.4,
       12.0,
       [](Effects& e, double s, Shape r, const Reach&) { e.rev_ripple = wave(s, r, {1, 2, 3.37, 5.61}); },
       [](const Effects& e) { return numbers("amplitude_N", e.rev_ripple); },
       {"cogging"}},
      {"encoder_eccentricity",
       scale,
       false,
       false,
       1e-6,
       2e-5,
       [](Effects& e, double s, Shape r, const Reach&) { e.encoder_eccentricity = wave(s, r, {1, 1, 2}); },
       [](const Effects& e) { return numbers("amplitude_m", e.encoder_eccentricity); },
       {"cyclic_lead_error"}},
      {"cyclic_lead_error",
       scale,
       false,
       false,
       3e-7,
       4e-6,
       [](Effects& e, double s, Shape r, const Reach&) { e.cyclic_lead_error = wave(s, r, {1, 1, 2}); },
       [](const Effects& e) { return numbers("amplitude_m", e.cyclic_lead_error); },
       {"encoder_eccentricity"}},
      {"lead_error",
       scale,
       false,
       false,
       2e-5,
       3e-4,
       [](Effects& e, double s, Shape r, const Reach&) { e.lead_error = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"relative_error", e.lead_error}}; },
       {"sensor_gain"}},
      {"screw_growth", scale, false, false, 2e-5, 1.5e-4,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.screw_growth = s;
         e.screw_growth_s = uniform(r, 2.0, 6.0);
       },
       [](const Effects& e) {
         return Numbers{{"relative_growth", e.screw_growth},
                        {"time_constant_s", e.screw_growth_s},
                        {"fixed_end_m", e.screw_fixed_end_m}};
       }},
      {"backlash",
       scale,
       false,
       false,
       8e-7,
       1.2e-5,
       [](Effects& e, double s, Shape, const Reach&) { e.gap_m = s; },
       [](const Effects& e) { return Numbers{{"gap_m", e.gap_m}}; },
       {"presliding_memory", "screw_compliance"}},
      {"screw_compliance",
       scale,
       false,
       false,
       0.5,
       1.0,
       [](Effects&, double, Shape, const Reach&) {},  // the axis itself is made compliant
       [](const Effects&) { return Numbers{}; },
       {"backlash", "presliding_memory"}},
      {"position_friction", none, true, false, 0.03, 0.9,
       [](Effects& e, double s, Shape r, const Reach&) { e.position_friction = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"relative_slope_per_half_stroke", e.position_friction}}; }},
      {"local_friction", none, true, false, 1.0, 60.0,
       [](Effects& e, double s, Shape r, const Reach& reach) {
         e.local_height_N = s;
         e.local_centre_m = uniform(r, -0.3, 0.3) * reach.position_m;
         e.local_half_width_m = uniform(r, 0.8e-3, 3e-3);
       },
       [](const Effects& e) {
         return Numbers{
             {"height_N", e.local_height_N}, {"centre_m", e.local_centre_m}, {"half_width_m", e.local_half_width_m}};
       }},
      {"sublinear_viscous", none, true, false, 0.05, 0.5,
       [](Effects& e, double s, Shape, const Reach&) { e.sublinear_exponent = 1.0 - s; },
       [](const Effects& e) {
         return Numbers{{"exponent", e.sublinear_exponent}, {"reference_speed_m_per_s", e.sublinear_speed_m_per_s}};
       }},
      {"presliding_memory",
       none,
       false,
       true,
       1.0,
       50.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.memory_N = s;
         e.memory_m = uniform(r, 5e-6, 5e-5);
       },
       [](const Effects& e) { return Numbers{{"force_N", e.memory_N}, {"distance_m", e.memory_m}}; },
       {"backlash"}},
      {"dwell_breakaway", none, false, true, 0.05, 0.6,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.dwell_rise = s;
         e.dwell_s = uniform(r, 0.3, 2.0);
       },
       [](const Effects& e) {
         return Numbers{
             {"relative_rise", e.dwell_rise}, {"time_constant_s", e.dwell_s}, {"memory_distance_m", e.dwell_memory_m}};
       }},
      {"frictional_lag", none, true, false, 0.001, 0.03,
       [](Effects& e, double s, Shape, const Reach&) { e.frictional_lag_s = s; },
       [](const Effects& e) { return Numbers{{"time_constant_s", e.frictional_lag_s}}; }},
      {"thermal_friction",
       none,
       true,
       false,
       0.03,
       0.45,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.thermal_reduction = s;
         e.thermal_J = uniform(r, 5.0, 25.0);
       },
       [](const Effects& e) { return Numbers{{"viscous_reduction", e.thermal_reduction}, {"energy_scale_J", e.thermal_J}}; },
       {"friction_drift"}},
      {"friction_drift",
       none,
       true,
       false,
       0.03,
       0.5,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.drift_change = sign(r) * s;
         e.drift_s = uniform(r, 1.0, 5.0);
       },
       [](const Effects& e) { return Numbers{{"relative_change", e.drift_change}, {"time_constant_s", e.drift_s}}; },
       {"thermal_friction"}},
      {"cable_spring", none, true, false, 20.0, 1500.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.cable_N_per_m = s;
         e.cable_neutral_m = uniform(r, -0.03, 0.03);
       },
       [](const Effects& e) { return Numbers{{"stiffness_N_per_m", e.cable_N_per_m}, {"neutral_m", e.cable_neutral_m}}; }},
      {"current_loop_lag",
       none,
       true,
       false,
       3e-4,
       5e-3,
       [](Effects& e, double s, Shape, const Reach&) { e.current_loop_s = s; },
       [](const Effects& e) { return Numbers{{"time_constant_s", e.current_loop_s}}; },
       {"input_delay"}},
      {"input_delay",
       none,
       true,
       false,
       2e-4,
       4e-3,
       [](Effects& e, double s, Shape, const Reach&) { e.input_delay_s = s; },
       [](const Effects& e) { return Numbers{{"delay_s", e.input_delay_s}}; },
       {"current_loop_lag"}},
      {"torque_saturation", none, false, false, 0.75, 0.93,
       [](Effects& e, double s, Shape, const Reach& reach) { e.saturation_Nm = s * reach.torque_Nm; },
       [](const Effects& e) { return Numbers{{"limit_Nm", e.saturation_Nm}}; }},
      {"quadratic_drag", none, true, false, 50.0, 8000.0,
       [](Effects& e, double s, Shape, const Reach&) { e.drag_Ns2_per_m2 = s; },
       [](const Effects& e) { return Numbers{{"coefficient_Ns2_per_m2", e.drag_Ns2_per_m2}}; }},
      {"floor_vibration",
       none,
       true,
       false,
       0.05,
       10.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.floor_m_per_s2 = s;
         e.floor_Hz = uniform(r, 8.0, 40.0);
       },
       [](const Effects& e) { return Numbers{{"acceleration_m_per_s2", e.floor_m_per_s2}, {"frequency_Hz", e.floor_Hz}}; },
       {"process_force"}},
      {"process_force",
       none,
       true,
       false,
       0.5,
       30.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.process_N = s;
         e.process_mean_N = 0.0;
         e.process_Hz = uniform(r, 30.0, 90.0);
       },
       [](const Effects& e) { return Numbers{{"amplitude_N", e.process_N}, {"frequency_Hz", e.process_Hz}}; },
       {"floor_vibration"}},
      {"hard_stop", none, false, false, 0.96, 0.995,
       [](Effects& e, double s, Shape, const Reach& reach) {
         e.stop_m = s * reach.position_m;
         e.stop_N_per_m = 2e5;
       },
       [](const Effects& e) {
         return Numbers{
             {"position_m", e.stop_m}, {"stiffness_N_per_m", e.stop_N_per_m}, {"damping_Ns_per_m", e.stop_Ns_per_m}};
       }},
      {"payload",
       none,
       true,
       false,
       1.0,
       20.0,
       [](Effects& e, double s, Shape, const Reach&) { e.payload_kg = s; },
       [](const Effects& e) { return Numbers{{"mass_kg", e.payload_kg}}; },
       {},
       true},
      {"gravity",
       force_sensor,
       false,
       true,
       1.0,
       40.0,
       [](Effects& e, double s, Shape r, const Reach&) { e.gravity_N = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"force_N", e.gravity_N}}; },
       {"torque_offset", "direction_dependent_friction"},
       false},
      {"copper_loss", power, false, false, 2.0, 25.0,
       [](Effects& e, double s, Shape, const Reach&) { e.copper_W_per_Nm2 = s; },
       [](const Effects& e) { return Numbers{{"coefficient_W_per_Nm2", e.copper_W_per_Nm2}}; }},
      {"regeneration_clipped", power, false, false, 1.0, 1.0,
       [](Effects& e, double s, Shape, const Reach&) { e.regeneration_lost = s; },
       [](const Effects& e) { return Numbers{{"share", e.regeneration_lost}}; }},
      {"power_meter_window", power, false, false, 0.02, 0.06,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.meter_window_s = std::round(1e3 * (sign(r) > 0.0 ? s : 5.0 * s)) * 1e-3;
       },
       [](const Effects& e) { return Numbers{{"window_s", e.meter_window_s}}; }},
      {"count_loss",
       scale,
       false,
       false,
       10.0,
       200.0,
       [](Effects& e, double s, Shape, const Reach&) { e.count_loss = std::round(s); },
       [](const Effects& e) { return Numbers{{"counts_per_pass", e.count_loss}, {"angle_rad", e.count_angle_rad}}; },
       {"lead_error"}},
      {"sensor_gain", torque_sensor | force_sensor, false, false, 0.04, 0.2,
       [](Effects& e, double s, Shape r, const Reach&) {
         (sign(r) > 0.0 ? e.torque_sensor_gain : e.force_sensor_gain) = 1.0 + sign(r) * s;
       },
       [](const Effects& e) {
         return Numbers{{"torque_sensor_gain", e.torque_sensor_gain}, {"force_sensor_gain", e.force_sensor_gain}};
       }},
      {"channel_skew", torque_sensor | force_sensor, false, false, 1e-3, 8e-3,
       [](Effects& e, double s, Shape r, const Reach&) {
         (sign(r) > 0.0 ? e.torque_sensor_delay_s : e.force_sensor_delay_s) = s;
       },
       [](const Effects& e) {
         return Numbers{{"torque_sensor_delay_s", e.torque_sensor_delay_s},
                        {"force_sensor_delay_s", e.force_sensor_delay_s}};
       }},
      {"wrong_lead", scale, false, false, 0.7, 1.4,
       [](Effects& e, double, Shape r, const Reach&) { e.lead_factor = one_of(r, {0.8, 1.25, 2.0, 0.5}); },
       [](const Effects& e) { return Numbers{{"factor", e.lead_factor}}; }},
      {"wrong_sign", torque_sensor | force_sensor, false, false, 1.0, 1.0,
       [](Effects& e, double, Shape r, const Reach&) {
         (sign(r) > 0.0 ? e.torque_sensor_sign : e.force_sensor_sign) = -1.0;
       },
       [](const Effects& e) {
         return Numbers{{"torque_sensor_sign", e.torque_sensor_sign}, {"force_sensor_sign", e.force_sensor_sign}};
       }},
      {"load_dependent_friction", torque_sensor | force_sensor, true, false, 0.02, 0.5,
       [](Effects& e, double s, Shape, const Reach&) { e.load_friction = s; },
       [](const Effects& e) { return Numbers{{"friction_per_load", e.load_friction}}; }},
      {"torque_gain_error",
       torque_sensor | force_sensor,
       false,
       false,
       0.04,
       0.2,
       [](Effects& e, double s, Shape r, const Reach&) { e.torque_gain = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"relative_error", e.torque_gain}}; },
       {"sensor_gain"}},
      {"torque_offset",
       torque_sensor,
       false,
       true,
       2e-3,
       0.03,
       [](Effects& e, double s, Shape r, const Reach&) { e.torque_offset_Nm = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"offset_Nm", e.torque_offset_Nm}}; },
       {"gravity", "direction_dependent_friction"},
       false},
      {"hidden_friction_compensation",
       torque_sensor,
       true,
       false,
       5e-3,
       0.05,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.hidden_Nm = s;
         e.hidden_m_per_s = uniform(r, 1e-3, 5e-3);
       },
       [](const Effects& e) { return Numbers{{"torque_Nm", e.hidden_Nm}, {"speed_m_per_s", e.hidden_m_per_s}}; },
       {},
       true},
  };
  return all;
}

const std::vector<Hidden>& outside() {
  static const std::vector<Hidden> all = {
      {"viscous_bowl", none, true, false, 0.05, 3.0, [](Effects& e, double s, Shape, const Reach&) { e.bowl_viscous = s; },
       [](const Effects&) { return Numbers{}; }},
      {"braking_mass", none, true, false, 1.0, 30.0,
       [](Effects& e, double s, Shape, const Reach&) { e.braking_mass_kg = s; }, [](const Effects&) { return Numbers{}; }},
      {"beating_friction", none, true, false, 0.5, 30.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.beat_N = s;
         e.beat_Hz = uniform(r, 0.6, 3.0);
       },
       [](const Effects&) { return Numbers{}; }},
      {"slosh", none, true, false, 0.5, 30.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.slosh_kg = s;
         e.slosh_Hz = uniform(r, 3.0, 8.0);
       },
       [](const Effects&) { return Numbers{}; }},
      {"washboard", none, true, false, 20.0, 2000.0,
       [](Effects& e, double s, Shape, const Reach&) { e.washboard_Ns_per_m = s; },
       [](const Effects&) { return Numbers{}; }},
  };
  return all;
}

bool identifiable(const Hidden& hidden, unsigned channels) {
  // the same equations, or the same to within what any channel shows
  for (const char* id : {"encoder_eccentricity", "cyclic_lead_error", "floor_vibration", "process_force", "torque_offset"})
    if (hidden.id == id) return false;
  if (hidden.id == "cogging") return (channels & torque_sensor) != 0;
  if (hidden.id == "presliding_memory") return (channels & scale) != 0;
  return (channels & hidden.needs) == hidden.needs;
}

const Hidden* find_hidden(const std::string& id) {
  for (const auto* list : {&catalogue(), &outside()})
    for (const auto& hidden : *list)
      if (hidden.id == id) return &hidden;
  return nullptr;
}

}  // namespace feedtwin::challenge
