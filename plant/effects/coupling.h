#pragma once
// A second mass: the table hangs on the screw by a spring with play, and carries the guide's friction.
//
//   d = x_screw - x_table,   e(d) = d beyond the gap (0 within),   U = k e^2 / 2
//   M_L dv_t/dt = F - F_guide(v_t) - F_table,   F = dU/dd + c dd/dt while in contact; beside a gap F never pulls
//
// Over a sub-step with the screw's mean velocity w and the table's w_t, s = h (w - w_t):
//
//   F = (U(d + s) - U(d)) / s + c (e(d + s) - e(d)) / h   (discrete gradient: no energy is made where a flank is hit)
//   2 M_L (w_t - v_t) / h = F - F_guide(w_t) - F_table(w_t)
//
// The table's equation is solved for w_t at the predicted w, and its dependence on w eliminated linearly:
//
//   dF/dw = K A / (A + K),   K = dF/dw at fixed w_t,   A = 2 M_L / h + slopes of guide and table
//
// so that the integrator sees a force with a bounded slope, whatever the stiffness. When the screw's real w is known the
// table is settled again, so that it never ends up inside a flank.
//
// Over a sub-step the mean force of a spring that swings is not that at the mean place, nor the mean velocity that of start
// and end. As in plant/substep.h both are mended, here for the motion of screw against table, r = w - w_t, which starts with
// r0 and has the reduced mass m and the frequency omega = sqrt(k / m):
//
//   w_t = (v_t + v_t') / 2 - kappa r,   F += - (2 kappa m / h) ((1 - kappa) r - r0)
//   kappa = 1 - x cot x = x^2 / 3 + x^4 / 45 + ...,   x = omega h / 2
//
// The first term is the fourth-order Fox-Goodwin rule, all of them give the swing its exact frequency; and the energy of
// spring and masses is kept exactly.
//
// Where a sub-step is too long for the swing (omega h > 2.8), force and mean velocity lean towards the end of the sub-step,
// up to backward Euler: stable at any stiffness, and what that takes is counted as lost in the spring.

#include <algorithm>
#include <cmath>
#include <utility>

#include "plant/effects/effect.h"
#include "plant/integrator.h"

namespace feedtwin::plant {

/// Two couplings one after the other: gaps add, springs and dampers give together. A stiffness of 0 stands for none yet.
[[nodiscard]] inline CouplingParameters in_series(const CouplingParameters& a, const CouplingParameters& b) noexcept {
  if (a.stiffness_N_per_m == 0.0) return b;
  const auto together = [](double one, double other) { return one + other > 0.0 ? one * other / (one + other) : 0.0; };
  return {a.gap_m + b.gap_m, together(a.stiffness_N_per_m, b.stiffness_N_per_m),
          together(a.damping_Ns_per_m, b.damping_Ns_per_m)};
}

class Coupling {
 public:
  Coupling(const CouplingParameters& parameters, const AxisModel<double>& model) noexcept;

  void place(double position_m, double velocity_m_per_s) noexcept;

  /// The table's motion as predicted for this sub-step: what its effects are asked with.
  [[nodiscard]] double predicted_velocity_m_per_s(double h_s) const noexcept FEEDTWIN_REALTIME {
    return velocity_m_per_s_ + 0.5 * h_s * acceleration_m_per_s2_;
  }

  /// Force on the screw over a sub-step. @param load what acts on the table beside guide and stops, at the predicted motion
  [[nodiscard]] EffectLoad respond(const EffectMotion& screw, double screw_before_m_per_s, const EffectLoad& load,
                                   const FrictionScale<double>& scale) noexcept FEEDTWIN_REALTIME;

  /// The sub-step is over: the screw moved with this mean velocity. Returns the table's.
  double finish(double screw_velocity_m_per_s) noexcept FEEDTWIN_REALTIME;

  /// Force now, between nut and table.
  [[nodiscard]] double force_N(double screw_position_m, double screw_velocity_m_per_s) const noexcept FEEDTWIN_REALTIME;

  /// That a tick of a millisecond takes for its swing; a flank that may be hit or left asks for all.
  [[nodiscard]] int substeps(int most, bool flank_bears) const noexcept {
    constexpr double tick_s = 1e-3, largest_swing_rad = 2.6;
    constexpr int least = 2;
    const double wanted = std::ceil(std::sqrt(rate_squared_per_s2_) * tick_s / largest_swing_rad);
    return !flank_bears || wanted > most ? most : std::min(most, std::max(least, static_cast<int>(wanted)));
  }

  /// Once a tick: does one flank bear, pressed in so far that at this rate it will for ticks to come?
  [[nodiscard]] bool flank_bears(double screw_position_m) noexcept FEEDTWIN_REALTIME {
    constexpr double ticks = 4.0;
    const double depth_m = beyond_gap_m(screw_position_m - position_m_);
    const double change_m = depth_m - std::exchange(depth_m_, depth_m);
    return !has_gap() || std::abs(depth_m) > ticks * std::abs(change_m);
  }

  [[nodiscard]] bool has_gap() const noexcept { return half_gap_m_ > 0.0; }
  [[nodiscard]] double position_m() const noexcept { return position_m_; }
  [[nodiscard]] double velocity_m_per_s() const noexcept { return velocity_m_per_s_; }
  [[nodiscard]] double acceleration_m_per_s2() const noexcept { return acceleration_m_per_s2_; }
  [[nodiscard]] double guide_J() const noexcept { return guide_J_; }  ///< work on the guide's friction
  [[nodiscard]] double stop_J() const noexcept { return stop_J_; }    ///< on the end stops
  [[nodiscard]] double own_J() const noexcept { return own_J_; }      ///< on spring and damper
  /// In the spring.
  [[nodiscard]] double spring_J(double screw_position_m) const noexcept {
    const double e_m = beyond_gap_m(screw_position_m - position_m_);
    return 0.5 * parameters_.stiffness_N_per_m * e_m * e_m;
  }
  /// In the guide's bristles.
  [[nodiscard]] double bristle_J() const noexcept { return 0.5 * guide_.stiffness_N_per_m * bristle_m_ * bristle_m_; }

 private:
  enum class Flank { changing, none, low, high };
  /// Force of the contact over a sub-step and its slope by the rate; and what the swing adds to the mid-point rule.
  struct ContactForce {
    double force_N = 0.0, slope_Ns_per_m = 0.0, kappa = 0.0;
    Flank flank = Flank::changing;
  };
  /// The table's mean velocity, and the contact there.
  struct Settled {
    double w, slope_Ns_per_m, kappa;
  };
  struct Trial {
    double screw_x, screw_w, h_s;
    double rate_before;  ///< of the screw against the table, at the start of the sub-step
    // what only the sub-step's length decides
    double per_h_Hz;
    double end_weight;                          ///< of the end velocity in the mean: 1/2 mid-point rule, 1 backward Euler
    double inertia_Ns_per_m, reduced_Ns_per_m;  ///< of the table, and twice that of screw against table
    double damping_Ns_per_m;
    double quarter_square, resolved;  ///< (omega h / 2)^2; 1 while a sub-step resolves the swing, towards 0 the longer it is
    double table_w;                   ///< linearised about
    double settled_w;                 ///< the table's, at screw_w
    EffectLoad force;                 ///< on the screw, about screw_w
    double others_N, others_slope;    ///< inertia, guide, stops and loads of the table, about table_w
    LugreStep<double> guide;
    ExtraLoad<double> stop;
  };
  [[nodiscard]] double beyond_gap_m(double d_m) const noexcept {
    return std::max(d_m - half_gap_m_, 0.0) + std::min(d_m + half_gap_m_, 0.0);
  }
  void set_sub_step(double h_s) noexcept;
  [[nodiscard]] Flank flank_at(double start_m, double rate_m_per_s) const noexcept;
  [[nodiscard]] ContactForce contact(double rate_m_per_s) const noexcept;
  [[nodiscard]] ContactForce swung(ContactForce contact, double bearing, double rate_m_per_s) const noexcept;
  void balance(double w_table, const EffectLoad& load, double load_at, const FrictionScale<double>& scale) noexcept;
  [[nodiscard]] Settled settle(double screw_w, double table_w) const noexcept;
  /// Inertia, guide, stops and loads of the table at a mean velocity.
  [[nodiscard]] double table_side_N(double w) const noexcept {
    return trial_.others_N + trial_.others_slope * (w - trial_.table_w);
  }

  static constexpr double longest_swing = 8.0;  ///< (omega h)^2
  CouplingParameters parameters_;
  double half_gap_m_, mass_kg_;
  double rate_squared_per_s2_;  ///< omega^2 of screw against table
  AxisModel<double> stops_;     ///< its end stops
  LugreBristle<double> guide_;
  LugreSide<double> pos_, neg_;
  double position_m_ = 0.0, velocity_m_per_s_ = 0.0, acceleration_m_per_s2_ = 0.0, bristle_m_ = 0.0;
  double depth_m_ = 0.0;  ///< in a flank, when it was last asked
  double guide_J_ = 0.0, stop_J_ = 0.0, own_J_ = 0.0;
  Trial trial_{};
};

}  // namespace feedtwin::plant
