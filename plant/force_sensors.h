#pragma once
// The source's torque and force sensor at an instant, Eqs. 12-14, for one axis or several at a time.
//
//   F_I = M_L a + F_L,   T_I = (J_B (2 pi / p_b)^2 a + F_B + F_I) p_b / 2 pi,   a from Eq. 1

#include <type_traits>

#include "plant/axis_model.h"
#include "plant/integrator.h"

namespace feedtwin::plant {

template <class Real>
struct SensedForces {
  Real torque_sensor_Nm{}, force_sensor_N{};
};

/// What a contact resists with now, in the direction of motion.
template <class Real>
[[nodiscard]] inline Real friction_now_N(const Contact<Real>& contact, Real velocity_m_per_s, Real bristle_m) noexcept {
  const Real one = Real{} + 1.0;
  return lugre_force_N<Real>(contact.bristle, side_in_force<Real>(contact, velocity_m_per_s > 0.0, one, one),
                             velocity_m_per_s, bristle_m);
}

/// @param drive_N net force under the acting command. Without effects. Wait-free.
template <class Real>
[[nodiscard]] inline SensedForces<Real> sensed_forces(const AxisModel<Real>& model, const AxisState<Real>& state,
                                                      Real drive_N, Real cutting_force_N) noexcept {
  const Real v = state.velocity_m_per_s;
  const auto positive = v > 0.0;
  Real screw_friction_N, guide_friction_N;
  if constexpr (std::is_same_v<Real, double>) {
    const auto& both = model.contacts.both;
    const auto friction = lugre_force_N<Doubles<2>>(both.bristle, positive ? both.pos : both.neg, Doubles<2>{} + v,
                                                    Doubles<2>{state.screw_bristle_m, state.guide_bristle_m});
    screw_friction_N = friction[0];
    guide_friction_N = friction[1];
  } else {
    screw_friction_N = friction_now_N<Real>(model.contacts.screw, v, state.screw_bristle_m);
    guide_friction_N = friction_now_N<Real>(model.contacts.guide, v, state.guide_bristle_m);
  }
  const Real stop_N = end_stop_load<Real>(model, state.position_m, v, Real{}).force_N;
  const Real coulomb_N = positive ? model.coulomb_pos_N : -model.coulomb_neg_N;
  const Real damping = positive ? model.damping_pos_Ns_per_m : model.damping_neg_Ns_per_m;
  const Real net_N = drive_N - coulomb_N - damping * v - screw_friction_N - guide_friction_N - stop_N;
  const auto moving = v != 0.0;
  const Real acceleration = moving ? net_N / model.mass_kg : Real{};  // at rest the motor's Coulomb friction holds
  const Real table_N = model.table_mass_kg * acceleration + guide_friction_N + stop_N + cutting_force_N;
  const Real screw_N = model.screw_mass_kg * acceleration + screw_friction_N + table_N;
  return {screw_N / model.transmission_rad_per_m, table_N};
}

}  // namespace feedtwin::plant
