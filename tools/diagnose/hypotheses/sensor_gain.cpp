// Gain of the torque and force sensors.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  if (view.track.torque_sensor_N.size() > 0) add(sum.torque_sensor_N, q[0] * view.track.torque_sensor_N);
  if (view.track.force_sensor_N.size() > 0) add(sum.force_sensor_N, q[1] * view.track.force_sensor_N);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"torque_relative_error", q[0]}, {"force_relative_error", q[1]}};
}

}  // namespace

Hypothesis sensor_gain() {
  return {.id = "sensor_gain",
          .component = "sensors",
          .channel = "torque_sensor_Nm",
          .where = Where::time,
          .parameters = {{"torque_relative_error", Kind::amplitude, 1e-3, -0.5, 0.5},
                         {"force_relative_error", Kind::amplitude, 1e-3, -0.5, 0.5}},
          .shapes = {{}},
          .apply = apply,
          .named = named,

          .sentence =
              "a sensor's gain is off: torque by {torque_relative_error}, force by {force_relative_error} of the reading",

          .confused_with = {"torque_gain_error"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
