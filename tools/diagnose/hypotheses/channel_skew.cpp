// Skew: a sensor is late against the encoder.

#include <algorithm>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/samples_later.h"
#include "tools/diagnose/shown_shift.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const auto late = [&](const Vector& reading, double delay_s) {
    return Vector(reading -
                  samples_later({reading.data(), static_cast<std::size_t>(reading.size())}, delay_s / track.sample_s));
  };
  if (track.torque_sensor_N.size() > 0) add(sum.torque_sensor_N, late(track.torque_sensor_N, q[0]));
  if (track.force_sensor_N.size() > 0) add(sum.force_sensor_N, late(track.force_sensor_N, q[1]));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"torque_sensor_delay_s", std::max(0.0, q[0])}, {"force_sensor_delay_s", std::max(0.0, q[1])}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return std::max(q[0], q[1]) > 6e-4;
}

/// Below it is how sensors are read.
bool finding(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return std::max(q[0], q[1]) > 1.1e-3;
}

/// By the sensor that is the later one.
bool shown(const std::vector<Track>& runs, std::span<const double> q) {
  return surely_shifted(shown_shift(runs, q[0] > q[1] ? &Track::torque_sensor_N : &Track::force_sensor_N));
}

}  // namespace

Hypothesis channel_skew() {
  return {
      .id = "channel_skew",
      .component = "sensors",
      .channel = "torque_sensor_Nm",
      .where = Where::time,
      .parameters = {{"torque_sensor_delay_s", Kind::amplitude, 1e-4, -1e-3, 0.05},
                     {"force_sensor_delay_s", Kind::amplitude, 1e-4, -1e-3, 0.05}},
      .shapes = {{}},
      .apply = apply,
      .named = named,
      .admissible = possible,
      .sentence =
          "the sensors are late against the encoder: torque by {torque_sensor_delay_s} s, force by {force_sensor_delay_s} s",
      .absorbed = true,
      .least_strength = 0.1,     // of a quiet sensor's half a newton: its channel has the last word
      .least_error_ratio = 2.0,  // what pre-sliding and a yielding screw leave looks late too: 1.04 to 1.6, true ones 3
      .shown = shown,
      .least_error_ratio_polished = 1.3,  // three true ones 1.44 to 1.99, four false ones 1.10 to 1.18, likelier all
      .only_readings = true,
      .finding = finding,
      .confused_with = {"input_delay", "current_loop_lag"},
      .reaches = {1.0, 20.0, 60.0},  // friction that turns round some samples later
      .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
