// Dead time: the command acts later.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const double samples = q[0] / view.track.sample_s;
  const Vector late = delayed(view.track.held_N, samples), about = about_sample(late);
  add(sum.drive_N, about - view.track.command_N);
  add(sum.metered_drive_N, late - about - (view.track.held_N - view.track.command_N));
  // at the sample's instant, when the sensors read, the command before still acts, however short the delay
  const Vector instant = delayed(view.track.held_N, std::max(1.0, std::ceil(samples)));
  add(sum.drive_step_N, instant - about - (view.track.held_N - view.track.command_N));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"delay_s", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 2e-5;
}

}  // namespace

Hypothesis input_delay() {
  return {.id = "input_delay",
          .component = "drive",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"delay_s", Kind::amplitude, 1e-4, 0.0, 0.05}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the command acts {delay_s} s late",
          .least_deviations = deviations_of_lags,
          .finding = late_beyond_a_model,
          .confused_with = {"current_loop_lag", "channel_skew", "frictional_lag"},
          .too_small_to_tell = gone_within_a_sample,
          .starts = {{1.5e-3}, {2.5e-3}, {3.5e-3}},  // a sensor reads another command with each whole tick
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
