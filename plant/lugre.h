#pragma once
// LuGre friction over one sub-step at constant velocity, in closed form.
//
//   g(v)  = F_C + (F_S - F_C) exp(-|v| / v_S)                                     paper Eq. 3
//   dz/dt = v - sigma0 |v| / g(v) z                       Canudas de Wit et al. 1995
//   F     = sigma0 z + sigma1 dz/dt + mu v                paper Eq. 2, with |v| for the misprinted |x|
//
// At a constant velocity v = s w (s the direction, w >= 0) the bristle relaxes with the distance travelled:
//
//   z(h)  = z_ss + (z_0 - z_ss) E(y),   z_ss = s g / sigma0,   y = sigma0 w h / g
//
// with E(y) = e^-y, here its Pade quotient 1 / (1 + y + y^2/2 + y^3/6): positive and falling, so |z| never leaves
// F_S / sigma0 however long the sub-step, and a bristle rate of 7e4 1/s at 0.1 m/s costs nothing. The mean of z is
// exact for that E, phi = (1 - E) / y, so work in = stored + lost holds to rounding.

#include "plant/lanes.h"

namespace feedtwin::plant {

/// One direction's coefficients, a lane each.
template <class Real>
struct LugreSide {
  Real coulomb_N{};                 ///< F_C
  Real stribeck_rise_N{};           ///< F_S - F_C
  Real inverse_stribeck_s_per_m{};  ///< 1 / v_S
  Real viscous_Ns_per_m{};          ///< mu
};

/// What both directions share.
template <class Real>
struct LugreBristle {
  Real stiffness_N_per_m{};   ///< sigma0
  Real compliance_m_per_N{};  ///< 1 / sigma0
  Real damping_Ns_per_m{};    ///< sigma1
};

/// What one contact does in a sub-step at the predicted speed, and its slope by the velocity.
template <class Real>
struct LugreStep {
  Real force_N{};  ///< mean force
  Real force_slope_Ns_per_m{};
  Real bristle_m{};  ///< z at the end
  Real bristle_slope_s{};
  Real bristle_limit_m{};  ///< |z| never leaves it: F_S / sigma0, or where it started
};

/// Steady friction g(v) of Eq. 3 at the speed |v|.
template <class Real>
[[nodiscard]] inline Real stribeck_force_N(const LugreSide<Real>& side, Real speed_m_per_s) noexcept {
  return side.coulomb_N + side.stribeck_rise_N * exp_of_minus<Real>(speed_m_per_s * side.inverse_stribeck_s_per_m);
}

/// Force at an instant, Eq. 2.
template <class Real>
[[nodiscard]] inline Real lugre_force_N(const LugreBristle<Real>& bristle, const LugreSide<Real>& side,
                                        Real velocity_m_per_s, Real z_m) noexcept {
  const Real speed = absolute<Real>(velocity_m_per_s);
  const Real z_rate = velocity_m_per_s - bristle.stiffness_N_per_m * speed * z_m / stribeck_force_N<Real>(side, speed);
  return bristle.stiffness_N_per_m * z_m + bristle.damping_Ns_per_m * z_rate + side.viscous_Ns_per_m * velocity_m_per_s;
}

/// @param sign +1 or -1; @param speed_m_per_s >= 0; @param z_m deflection at the start; @param h_s > 0
template <class Real>
[[nodiscard]] inline LugreStep<Real> lugre_step(const LugreBristle<Real>& bristle, const LugreSide<Real>& side, Real sign,
                                                Real speed_m_per_s, Real z_m, Real h_s, Real per_h_Hz) noexcept {
  const Real rise = side.stribeck_rise_N * exp_of_minus<Real>(speed_m_per_s * side.inverse_stribeck_s_per_m);
  const Real g = side.coulomb_N + rise;
  const Real dg = -rise * side.inverse_stribeck_s_per_m;  // every d... is by the speed

  // E, phi and their slopes with y = c / g, multiplied through by powers of g: one division for all
  const Real c = bristle.stiffness_N_per_m * h_s * speed_m_per_s;
  const Real g2 = g * g;
  const Real tail = c * (0.5 * g + (1.0 / 6.0) * c);
  const Real per_denominator = 1.0 / (g2 * (g + c) + c * tail);
  const Real E = g2 * g * per_denominator;
  const Real phi = g * (g2 + tail) * per_denominator;
  const Real fall = (g2 + c * (g + 0.5 * c)) * per_denominator;                                  // -dE/dy / (E g)
  const Real dy = bristle.stiffness_N_per_m * h_s * (g - speed_m_per_s * dg) * per_denominator;  // g^2 dy / denominator
  const Real dE = -g2 * fall * dy;
  const Real dphi = (0.5 * g + (1.0 / 3.0) * c - (g2 + tail) * fall) * dy;

  const Real toward = sign * bristle.compliance_m_per_N;
  const Real z_ss = toward * g;
  const Real dz_ss = toward * dg;
  const Real offset = z_m - z_ss;
  const Real z_mean = z_ss + offset * phi;
  const Real z_end = z_ss + offset * E;
  const Real dz_mean = dz_ss * (1.0 - phi) + offset * dphi;
  const Real dz_end = dz_ss * (1.0 - E) + offset * dE;

  const Real damping_per_h = bristle.damping_Ns_per_m * per_h_Hz;
  return {bristle.stiffness_N_per_m * z_mean + damping_per_h * (z_end - z_m) + sign * side.viscous_Ns_per_m * speed_m_per_s,
          sign * (bristle.stiffness_N_per_m * dz_mean + damping_per_h * dz_end) + side.viscous_Ns_per_m, z_end,
          sign * dz_end,
          larger<Real>(absolute<Real>(z_m), bristle.compliance_m_per_N * (side.coulomb_N + side.stribeck_rise_N))};
}

}  // namespace feedtwin::plant
