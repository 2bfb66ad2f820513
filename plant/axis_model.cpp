#include "plant/axis_model.h"

#include <algorithm>
#include <numbers>

namespace feedtwin::plant {
namespace {

using Pair = Doubles<2>;

LugreSide<Pair> side(const LugreParameters& screw, const LugreParameters& guide, double Directional::* direction) {
  const auto rise = [direction](const LugreParameters& p) {
    return std::max(0.0, p.static_N.*direction - p.coulomb_N.*direction);
  };
  return {Pair{screw.coulomb_N.*direction, guide.coulomb_N.*direction}, Pair{rise(screw), rise(guide)},
          1.0 / Pair{screw.stribeck_m_per_s.*direction, guide.stribeck_m_per_s.*direction},
          Pair{screw.viscous_Ns_per_m.*direction, guide.viscous_Ns_per_m.*direction}};
}

}  // namespace

AxisModel<double> make_axis_model(const AxisParameters& parameters) {
  const double k = 2.0 * std::numbers::pi / parameters.axis.lead_m;
  AxisModel<double> model;
  model.transmission_rad_per_m = k;
  model.motor_mass_kg = parameters.motor.inertia_kgm2 * k * k;
  model.screw_mass_kg = parameters.ball_screw_inertia_kgm2 * k * k;
  model.table_mass_kg = parameters.guide_mass_kg;
  model.mass_kg = model.motor_mass_kg + model.screw_mass_kg + model.table_mass_kg;
  model.per_mass_per_kg = 1.0 / model.mass_kg;
  model.damping_pos_Ns_per_m = parameters.motor.damping_Nms.pos * k * k;
  model.damping_neg_Ns_per_m = parameters.motor.damping_Nms.neg * k * k;
  model.coulomb_pos_N = parameters.motor.coulomb_N.pos;
  model.coulomb_neg_N = parameters.motor.coulomb_N.neg;

  const auto& screw = parameters.ball_screw;
  const auto& guide = parameters.guide;
  const Pair stiffness = {screw.stiffness_N_per_m, guide.stiffness_N_per_m};
  model.contacts.both = {side(screw, guide, &Directional::pos),
                         side(screw, guide, &Directional::neg),
                         {stiffness, 1.0 / stiffness, Pair{screw.damping_Ns_per_m, guide.damping_Ns_per_m}}};

  const auto damping_rate_Hz = [&](double motor_Ns_per_m, double Directional::* direction) {
    return (motor_Ns_per_m + screw.viscous_Ns_per_m.*direction + guide.viscous_Ns_per_m.*direction) / model.mass_kg;
  };
  model.damping_rate_pos_Hz = damping_rate_Hz(model.damping_pos_Ns_per_m, &Directional::pos);
  model.damping_rate_neg_Hz = damping_rate_Hz(model.damping_neg_Ns_per_m, &Directional::neg);

  const double half_stroke = 0.5 * parameters.axis.stroke_m;
  model.stop_low_m = parameters.axis.stroke_centre_m - half_stroke;
  model.stop_high_m = parameters.axis.stroke_centre_m + half_stroke;
  model.stop_stiffness_N_per_m = parameters.axis.end_stop_stiffness_N_per_m;
  model.stop_damping_Ns_per_m = parameters.axis.end_stop_damping_Ns_per_m;
  return model;
}

}  // namespace feedtwin::plant
