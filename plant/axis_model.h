#pragma once
// Eq. 1 as numbers ready for the integrator: everything reduced to the table (force in N, motion in m).
//
//   [(J_M + J_B)(2 pi / p_b)^2 + M_L] dv/dt + B_M (2 pi / p_b)^2 v = u - F_M - F_B - F_L - F_C

#include "plant/contacts.h"
#include "plant/parameters.h"

namespace feedtwin::plant {

/// Coefficients of one axis (Real = double) or of several, one a lane.
template <class Real>
struct AxisModel {
  Real transmission_rad_per_m{};  ///< 2 pi / p_b
  Real mass_kg{};                 ///< all inertia as mass at the table
  Real per_mass_per_kg{};         ///< 1 / mass
  Real motor_mass_kg{}, screw_mass_kg{}, table_mass_kg{};
  Real damping_pos_Ns_per_m{}, damping_neg_Ns_per_m{};  ///< B_M (2 pi / p_b)^2
  Real coulomb_pos_N{}, coulomb_neg_N{};                ///< F_M
  Real damping_rate_pos_Hz{}, damping_rate_neg_Hz{};    ///< all viscous friction over all mass
  Contacts<Real> contacts;
  Real stop_low_m{}, stop_high_m{}, stop_stiffness_N_per_m{}, stop_damping_Ns_per_m{};
};

/// State of an axis between ticks.
template <class Real>
struct AxisState {
  Real position_m{};
  Real velocity_m_per_s{};
  Real screw_bristle_m{};
  Real guide_bristle_m{};
  Real acceleration_m_per_s2{};  ///< of the last sub-step: predicts the next one's mean speed
  Real drive_N{};                ///< net applied force of the last tick
};

/// What the components have taken since the start, in J. Losses never fall; the work on cutting and stops is signed.
template <class Real>
struct AxisLosses {
  Real motor_J{};                       ///< F_M and B_M
  Real screw_J{};                       ///< work done on the ball screw's friction, stored bristle energy included
  Real guide_J{};                       ///< likewise on the guide's
  Real stop_J{};                        ///< work done on the end stops
  Real travel_pos_m{}, travel_neg_m{};  ///< for Eq. 7's k_e1
  Real speed_travel_pos_m2_per_s{}, speed_travel_neg_m2_per_s{};  ///< integral of v^2 dt, for Eq. 7's k_e2

  AxisLosses& operator+=(const AxisLosses& more) noexcept {
    motor_J += more.motor_J;
    screw_J += more.screw_J;
    guide_J += more.guide_J;
    stop_J += more.stop_J;
    travel_pos_m += more.travel_pos_m;
    travel_neg_m += more.travel_neg_m;
    speed_travel_pos_m2_per_s += more.speed_travel_pos_m2_per_s;
    speed_travel_neg_m2_per_s += more.speed_travel_neg_m2_per_s;
    return *this;
  }
};

/// The coefficients of one axis from its parameters.
[[nodiscard]] AxisModel<double> make_axis_model(const AxisParameters& parameters);

}  // namespace feedtwin::plant
