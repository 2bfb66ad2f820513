#pragma once
// Which of several models the closed loop bears out.

#include "tools/diagnose/forward/forward_model.h"

namespace feedtwin::tools::diagnosis {

/// Mean logarithm of the closed loop's error on the runs, all channels alike.
[[nodiscard]] double far_off(const ForwardModel& forward, const AxisByRun& axis);

/// Which axis's closed loop comes closest to the runs, all channels alike; the first where none is clearly closer.
[[nodiscard]] std::size_t closest(const ForwardModel& forward, const std::vector<AxisByRun>& axes);

/// Polished numbers that leave a channel so many times as far off are none: a force that disturbs the axis made half of a
/// table's mass the likeliest.
inline constexpr double far_worse_polished = 1.5;

/// By errors of a channel alone: what a model repeats badly says little of it, but that the model comes nearer than it
/// repeats is no chance.
/// @param repeated the named model's error on what it makes itself, as recorded
[[nodiscard]] bool is_far_worse(double rival, double named, double repeated, double far_worse);

/// Does the rival leave a channel far worse than the named one does, as the inverse model has it? Then the sum over all
/// channels is another's doing: a screw's compliance was 31634 nats likelier than the gap that was there, and four times as
/// far off on the scale.
/// @param far_worse how many times as far off
[[nodiscard]] bool spoils_a_channel(const ForwardModel& forward, const Candidate& rival, const Candidate& named,
                                    double far_worse = 2.0);

/// Does one simulate some channel so much worse than the other that no name can be judged by its numbers?
[[nodiscard]] bool is_far_behind(const ForwardModel& forward, const Candidate& behind, const Candidate& ahead);

/// Are a model's polished numbers better than what they were? As the runs go, or beyond the scatter of their stretches
/// likelier: a few rows of a jump may outweigh them in the sum.
[[nodiscard]] bool is_better(const ForwardModel& forward, const Candidate& polished, const Candidate& before);

/// What its numbers alone can do, by the same measure as a named model: or the gain would be the polishing's.
[[nodiscard]] Candidate polished_if_closer(const ForwardModel& forward, const Fitter& fitter, const Candidate& start);

}  // namespace feedtwin::tools::diagnosis
