// Current loop: the motor's torque follows the command with a first-order lag.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const double tau = std::max(q[0], 1e-9), h = track.sample_s, keep = std::exp(-h / tau);
  Vector torque(track.size), instant(track.size);  // mean over each sample, at its start
  double at = track.held_N[0];
  for (Index k = 0; k < track.size; ++k) {
    const double command = track.held_N[k];
    instant[k] = at;
    torque[k] = command + (at - command) * tau / h * (1.0 - keep);
    at = command + (at - command) * keep;
  }
  add(sum.drive_N, about_sample(torque) - track.command_N);
  add(sum.drive_step_N, instant - about_sample(torque) - (track.held_N - track.command_N));
  add(sum.metered_drive_N, torque - about_sample(torque) - (track.held_N - track.command_N));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"time_constant_s", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 2e-5;
}

}  // namespace

Hypothesis current_loop_lag() {
  return {.id = "current_loop_lag",
          .component = "drive",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"time_constant_s", Kind::amplitude, 1e-4, 0.0, 0.05}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the drive's current loop lags: first order, {time_constant_s} s",
          .least_deviations = deviations_of_lags,
          .finding = late_beyond_a_model,
          .confused_with = {"input_delay", "channel_skew", "frictional_lag"},
          .too_small_to_tell = gone_within_a_sample,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
