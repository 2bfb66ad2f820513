#pragma once
// One tick of Eq. 1: a linearly implicit mid-point rule with the friction of each sub-step in closed form.
//
// The sub-step is in plant/substep.h; a tick takes as many as the nearness of a reversal asks for.
//
// Bounded: at most substeps + extra_substeps evaluations a tick, no allocation, no branch on data other than events.

#include <algorithm>

#include "plant/axis_model.h"
#include "plant/end_stop.h"
#include "plant/substep.h"

namespace feedtwin::plant {

/// Sub-steps a tick, by how near a reversal is: there the bristles turn over within a few micrometres and swing at up to 120
/// Hz.
struct Resolution {
  int sliding = 1;
  int settling = 2;
  int reversing = 3;
  double settling_within_ticks = 12.0;
  double reversing_within_ticks = 2.0;
  int swinging = 6;  ///< at most, for the table's swing against the screw: all of them where a gap closes
};
inline constexpr Resolution one_count{};                           ///< position within one count of 76 nm
inline constexpr Resolution tenth_of_a_count{1, 2, 5, 30.0, 3.0};  ///< within a tenth
inline constexpr int extra_substeps = 12;                          ///< for reversals within a tick
/// Of the nominal sub-step: what is left of a tick is taken in one if it can be.
inline constexpr double longest_substep = 1.26;

/// Advance by one tick under the constant net applied force `drive_N` (motor less cutting force).
/// Returns what the components took in it. Wait-free; at most sub-steps + extra_substeps evaluations.
template <class Real, class Effects>
inline AxisLosses<Real> integrate_tick(const AxisModel<Real>& model, AxisState<Real>& axis_state, Effects& effects,
                                       Real drive_N, double tick_s, const Resolution& resolution) noexcept {
  AxisState<Real> state = axis_state;  // a copy, so that it stays in registers
  AxisLosses<Real> taken{};
  state.acceleration_m_per_s2 += (drive_N - state.drive_N) * model.per_mass_per_kg;
  state.drive_N = drive_N;
  const Real speed = absolute<Real>(state.velocity_m_per_s);
  // how near a reversal: the time, in ticks, that the velocity would take to it
  const Real per_tick = absolute<Real>(state.acceleration_m_per_s2) * tick_s;
  const Real reversing_s = Real{} + tick_s / resolution.reversing, settling_s = Real{} + tick_s / resolution.settling,
             sliding_s = Real{} + tick_s / resolution.sliding;
  const Real nominal_s = speed > resolution.settling_within_ticks * per_tick    ? sliding_s
                         : speed > resolution.reversing_within_ticks * per_tick ? settling_s
                                                                                : reversing_s;
  const int most = std::max({resolution.sliding, resolution.settling, resolution.reversing}) + extra_substeps;
  const double rounding_s = 1e-9 * tick_s;
  const Real whole_s = longest_substep * nominal_s;
  Real left_s = Real{} + tick_s;
  for (int i = 0; i < most && any(left_s > 0.0); ++i) {
    const MaskOf<Real> ended = !(left_s > 0.0);
    const Real h_s = ended ? nominal_s : (left_s < whole_s ? left_s : nominal_s);
    left_s -= detail::substep<Real>(model, state, taken, effects, h_s, ended);
    left_s = left_s > rounding_s ? left_s : Real{};
  }
  axis_state = state;
  return taken;
}

}  // namespace feedtwin::plant
