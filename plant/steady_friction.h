#pragma once
// A LuGre contact once its bristles have settled, Eqs. 2-3:  F = s (F_C + (F_S - F_C) exp(-|v| / v_S)) + mu v,  s = sgn v.
// All SI: N, m/s. Wait-free.

#include <cmath>

#include "plant/parameters.h"

namespace feedtwin::plant {

/// g(v) of Eq. 3 at a speed >= 0, for motion forth or back.
[[nodiscard]] inline double stribeck_force_N(const LugreParameters& contact, bool forth, double speed_m_per_s) noexcept {
  const auto side = forth ? &Directional::pos : &Directional::neg;
  const double coulomb_N = contact.coulomb_N.*side;
  return coulomb_N + (contact.static_N.*side - coulomb_N) * std::exp(-speed_m_per_s / contact.stribeck_m_per_s.*side);
}

/// Against the motion: of the velocity's sign, at rest as for motion back.
[[nodiscard]] inline double steady_force_N(const LugreParameters& contact, double velocity_m_per_s) noexcept {
  const bool forth = velocity_m_per_s > 0.0;
  const double sliding_N = stribeck_force_N(contact, forth, std::abs(velocity_m_per_s));
  return (forth ? sliding_N : -sliding_N) +
         (forth ? contact.viscous_Ns_per_m.pos : contact.viscous_Ns_per_m.neg) * velocity_m_per_s;
}

}  // namespace feedtwin::plant
