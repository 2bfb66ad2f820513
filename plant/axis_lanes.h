#pragma once
// Several axes in the lanes of vector registers: packing and unpacking. integrate_tick<Doubles<N>> then steps N of them at
// once.

#include <cstddef>

#include "plant/axis_model.h"

namespace feedtwin::plant {
namespace detail {

template <class Real>
void set_side(LugreSide<Real>& to, std::size_t lane, const LugreSide<Doubles<2>>& from, int contact) noexcept {
  to.coulomb_N[lane] = from.coulomb_N[contact];
  to.stribeck_rise_N[lane] = from.stribeck_rise_N[contact];
  to.inverse_stribeck_s_per_m[lane] = from.inverse_stribeck_s_per_m[contact];
  to.viscous_Ns_per_m[lane] = from.viscous_Ns_per_m[contact];
}

template <class Real>
void set_contact(Contact<Real>& to, std::size_t lane, const Contact<Doubles<2>>& from, int contact) noexcept {
  set_side(to.pos, lane, from.pos, contact);
  set_side(to.neg, lane, from.neg, contact);
  to.bristle.stiffness_N_per_m[lane] = from.bristle.stiffness_N_per_m[contact];
  to.bristle.compliance_m_per_N[lane] = from.bristle.compliance_m_per_N[contact];
  to.bristle.damping_Ns_per_m[lane] = from.bristle.damping_Ns_per_m[contact];
}

}  // namespace detail

/// Put one axis's coefficients into a lane. Every lane must be set before use: an empty one has no mass.
template <class Real>
void set_lane(AxisModel<Real>& to, std::size_t lane, const AxisModel<double>& from) noexcept {
  to.transmission_rad_per_m[lane] = from.transmission_rad_per_m;
  to.mass_kg[lane] = from.mass_kg;
  to.per_mass_per_kg[lane] = from.per_mass_per_kg;
  to.motor_mass_kg[lane] = from.motor_mass_kg;
  to.screw_mass_kg[lane] = from.screw_mass_kg;
  to.table_mass_kg[lane] = from.table_mass_kg;
  to.damping_pos_Ns_per_m[lane] = from.damping_pos_Ns_per_m;
  to.damping_neg_Ns_per_m[lane] = from.damping_neg_Ns_per_m;
  to.coulomb_pos_N[lane] = from.coulomb_pos_N;
  to.coulomb_neg_N[lane] = from.coulomb_neg_N;
  to.damping_rate_pos_Hz[lane] = from.damping_rate_pos_Hz;
  to.damping_rate_neg_Hz[lane] = from.damping_rate_neg_Hz;
  detail::set_contact(to.contacts.screw, lane, from.contacts.both, 0);
  detail::set_contact(to.contacts.guide, lane, from.contacts.both, 1);
  to.stop_low_m[lane] = from.stop_low_m;
  to.stop_high_m[lane] = from.stop_high_m;
  to.stop_stiffness_N_per_m[lane] = from.stop_stiffness_N_per_m;
  to.stop_damping_Ns_per_m[lane] = from.stop_damping_Ns_per_m;
}

template <class Real>
void set_lane(AxisState<Real>& to, std::size_t lane, const AxisState<double>& from) noexcept {
  to.position_m[lane] = from.position_m;
  to.velocity_m_per_s[lane] = from.velocity_m_per_s;
  to.screw_bristle_m[lane] = from.screw_bristle_m;
  to.guide_bristle_m[lane] = from.guide_bristle_m;
  to.acceleration_m_per_s2[lane] = from.acceleration_m_per_s2;
  to.drive_N[lane] = from.drive_N;
}

template <class Real>
[[nodiscard]] AxisState<double> lane_of(const AxisState<Real>& from, std::size_t lane) noexcept {
  return {from.position_m[lane],      from.velocity_m_per_s[lane],      from.screw_bristle_m[lane],
          from.guide_bristle_m[lane], from.acceleration_m_per_s2[lane], from.drive_N[lane]};
}

template <class Real>
[[nodiscard]] AxisLosses<double> lane_of(const AxisLosses<Real>& from, std::size_t lane) noexcept {
  return {from.motor_J[lane],
          from.screw_J[lane],
          from.guide_J[lane],
          from.stop_J[lane],
          from.travel_pos_m[lane],
          from.travel_neg_m[lane],
          from.speed_travel_pos_m2_per_s[lane],
          from.speed_travel_neg_m2_per_s[lane]};
}

}  // namespace feedtwin::plant
