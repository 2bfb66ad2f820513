// Skew: the force sensors are sampled later than the encoder.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  for (Vector Contribution::* sensor : {&Contribution::torque_sensor_N, &Contribution::force_sensor_N}) {
    const Vector& reading =
        sensor == &Contribution::torque_sensor_N ? view.track.torque_sensor_N : view.track.force_sensor_N;
    if (reading.size() > 0) add(sum.*sensor, reading - delayed(reading, -q[0] / view.track.sample_s));
  }
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"skew_s", q[0]}};
}

}  // namespace

Hypothesis channel_skew() {
  return {.id = "channel_skew",
          .component = "sensors",
          .channel = "torque_sensor_Nm",
          .where = Where::time,
          .parameters = {{"skew_s", Kind::amplitude, 1e-4, -0.05, 0.05}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .sentence = "the force sensors are sampled {skew_s} s apart from the rest",
          .confused_with = {"input_delay", "current_loop_lag"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
