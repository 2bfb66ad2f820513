// Torque constant: the motor gives (1 + g) times its command.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double most = 0.25;

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  // without a sensor behind the motor, and without a power meter, every friction number takes it up
  const bool metered = !track.meter.starts.empty() && !track.meter.of_command;
  if (track.torque_sensor_N.size() == 0 && track.force_sensor_N.size() == 0 && !metered) return;
  add(sum.drive_N, q[0] * track.command_N);
  add(sum.metered_drive_N, q[0] * (track.held_N - track.command_N));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_error", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return std::abs(q[0]) > 0.03 && std::abs(q[0]) < 0.99 * most;  // at its bound it stands for something else
}

}  // namespace

Hypothesis torque_gain_error() {
  return {.id = "torque_gain_error",
          .component = "drive",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"relative_error", Kind::amplitude, 1e-3, -most, most}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the motor gives {relative_error} of its commanded torque more than it says",
          .absorbed = true,
          .least_missed_nats = 500.0,  // true ones 3360 and more; where noise was named so, 156
          .least_missed_nats_far_off = 100.0,
          .least_deviations = deviations_of_numbers,
          .law_error = 0.03,
          .confused_with = {"sensor_gain"},
          .closed_loop_starts = {{0.0}},
          .told_by_runs_nats = 500.0,
          .most_told_by_runs = 0.1,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
