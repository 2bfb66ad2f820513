#pragma once
// What acts on an axis beside Eq. 1's own terms: effects, and the stops at the ends of its travel.

#include "plant/axis_model.h"

namespace feedtwin::plant {

/// What acts in a sub-step beside Eq. 1's own terms.
template <class Real>
struct ExtraLoad {
  Real force_N{};  ///< against positive motion, at the predicted mean velocity
  Real force_slope_Ns_per_m{};
  FrictionScale<Real> scale{};
};

/// No effect beyond the paper's model. Effects offer the same two functions (plant/effects).
template <class Real>
struct NoEffects {
  [[nodiscard]] ExtraLoad<Real> before(const AxisState<Real>& /*start*/, const Sliding<Real>& /*predicted*/) noexcept {
    return {};
  }
  void after(const AxisState<Real>& /*end*/, Real /*mean_velocity_m_per_s*/, Real /*h_s*/) noexcept {}
};

/// End stops: a spring and damper beyond either end, pushing only inwards.
template <class Real>
[[nodiscard]] inline ExtraLoad<Real> end_stop_load(const AxisModel<Real>& model, Real position_m, Real mean_velocity_m_per_s,
                                                   Real h_s) noexcept {
  const Real zero{};
  const auto at_high = position_m >= model.stop_high_m;
  const auto at_low = position_m <= model.stop_low_m;
  const auto touching = at_high | at_low;
  const Real depth = at_high ? position_m - model.stop_high_m : (at_low ? position_m - model.stop_low_m : zero);
  const Real stiffness = touching ? model.stop_stiffness_N_per_m : zero;
  const Real damping = touching ? model.stop_damping_Ns_per_m : zero;
  const Real slope = damping + 0.5 * h_s * stiffness;
  const Real force = stiffness * depth + slope * mean_velocity_m_per_s;
  const auto pulls = (at_high & (force < 0.0)) | (at_low & (force > 0.0));
  return {pulls ? zero : force, pulls ? zero : slope, {}};
}

}  // namespace feedtwin::plant
