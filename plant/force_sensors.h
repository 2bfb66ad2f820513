#pragma once
// The source's torque and force sensor at an instant, Eqs. 12-14, for one axis or several at a time.
//
//   F_I = M_L a + F_L + F_C,   T_I = (J_B (2 pi / p_b)^2 a + F_B + F_I) p_b / 2 pi,   a from Eq. 1

#include "plant/axis_model.h"
#include "plant/end_stop.h"

namespace feedtwin::plant {

template <class Real>
struct SensedForces {
  Real torque_sensor_Nm{}, force_sensor_N{};
};

/// @param motor_N what the motor drives with, reduced to the table; @param screw_N what resists at the screw but inertia,
/// @param table_N at the table: friction, end stops, cutting, effects. Wait-free.
template <class Real>
[[nodiscard]] inline SensedForces<Real> sensed_forces(const AxisModel<Real>& model, Real velocity_m_per_s, Real motor_N,
                                                      Real screw_N, Real table_N) noexcept {
  const auto positive = velocity_m_per_s > 0.0;
  const auto moving = velocity_m_per_s != 0.0;
  const Real coulomb_N = positive ? model.coulomb_pos_N : -model.coulomb_neg_N;
  const Real damping = positive ? model.damping_pos_Ns_per_m : model.damping_neg_Ns_per_m;
  const Real net_N = motor_N - coulomb_N - damping * velocity_m_per_s - screw_N - table_N;
  const Real acceleration = moving ? net_N / model.mass_kg : Real{};  // at rest the motor's Coulomb friction holds
  const Real sensed_N = model.table_mass_kg * acceleration + table_N;
  return {(model.screw_mass_kg * acceleration + screw_N + sensed_N) / model.transmission_rad_per_m, sensed_N};
}

/// An axis without effects. @param drive_N net force under the acting command: motor's less cutting
template <class Real>
[[nodiscard]] inline SensedForces<Real> sensed_forces(const AxisModel<Real>& model, const AxisState<Real>& state,
                                                      Real drive_N, Real cutting_force_N) noexcept {
  const Real v = state.velocity_m_per_s;
  const auto friction = model.contacts.now(v, state.screw_bristle_m, state.guide_bristle_m, FrictionScale<Real>{});
  const Real stop_N = end_stop_load<Real>(model, state.position_m, v, Real{}).force_N;
  return sensed_forces<Real>(model, v, drive_N + cutting_force_N, friction.screw_N,
                             friction.guide_N + stop_N + cutting_force_N);
}

}  // namespace feedtwin::plant
