// Gain of the torque sensor or of the force sensor. One of them: both alike are the torque constant, and beside the one that
// is off the other would take up what the guide's numbers leave.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

enum Sensor { torque, force };

constexpr double largest_error = 0.8;

bool about(std::span<const double> q, Sensor sensor) {
  return std::lround(q[2]) == sensor;
}

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  // of the force that the model says is there: the reading's own noise has no part in it
  if (view.base().screw_N.size() == 0) return;
  const Track& track = view.track;
  const double k = per_lead(view.transmission());
  const Vector table = view.base().guide_N + view.axis().guide_mass_kg * track.table_acceleration_m_per_s2;
  const Vector screw =
      table + view.base().screw_N + view.axis().ball_screw_inertia_kgm2 * k * k * track.acceleration_m_per_s2;
  if (about(q, torque) && track.torque_sensor_N.size() > 0) add(sum.torque_sensor_N, q[0] * screw);
  if (about(q, force) && track.force_sensor_N.size() > 0) add(sum.force_sensor_N, q[1] * table);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"torque_sensor_gain", about(q, torque) ? 1.0 + q[0] : 1.0},
          {"force_sensor_gain", about(q, force) ? 1.0 + q[1] : 1.0}};
}

std::string_view reading(std::span<const double> q) {
  return about(q, torque) ? channel::torque_sensor_Nm : channel::force_sensor_N;
}

/// One that runs to its bound stands for something else.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  const double error = std::abs(q[about(q, torque) ? 0 : 1]);
  return error > 0.03 && error < 0.95 * largest_error;
}

}  // namespace

Hypothesis sensor_gain() {
  return {.id = "sensor_gain",
          .component = "sensors",
          .channel = "torque_sensor_Nm",
          .where = Where::time,
          .parameters = {{"torque_relative_error", Kind::amplitude, 1e-3, -largest_error, largest_error},
                         {"force_relative_error", Kind::amplitude, 1e-3, -largest_error, largest_error},
                         {"sensor", Kind::fixed, 1.0, 0.0, 1.0}},
          .shapes = {{torque}, {force}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence =
              "a sensor's gain is off: the torque sensor shows {torque_sensor_gain}, the force sensor {force_sensor_gain} "
              "of the truth",
          .absorbed = true,
          .far_off_gain = 40.0,
          .least_deviations = deviations_of_numbers,
          .law_error = 0.005,
          .only_readings = true,
          .reading = reading,
          .confused_with = {"torque_gain_error"},
          // far off too: from none a sensor of 0.71 of the truth was 0.99, which two thirds of all numbers made up for
          .starts = {{0.0, 0.0, torque}, {0.0, 0.0, force}, {-0.3, 0.0, torque}, {0.0, -0.3, force}},
          .closed_loop_starts = {{0.0, 0.0, torque}, {0.0, 0.0, force}},
          .told_by_runs_nats = 500.0,
          .most_told_by_runs = 0.1,  // what only fitted otherwise shaped friction better was 16 to 21 %
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
