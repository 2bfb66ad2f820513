// Gain of the torque and force sensors.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  // of the force that the model says is there: the reading's own noise has no part in it
  if (view.base.screw_N.size() == 0) return;
  const Track& track = view.track;
  const double k = per_lead(view.axis);
  const Vector table = view.base.guide_N + view.axis.guide_mass_kg * track.table_acceleration_m_per_s2;
  const Vector screw = table + view.base.screw_N + view.axis.ball_screw_inertia_kgm2 * k * k * track.acceleration_m_per_s2;
  if (track.torque_sensor_N.size() > 0) add(sum.torque_sensor_N, q[0] * screw);
  if (track.force_sensor_N.size() > 0) add(sum.force_sensor_N, q[1] * table);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"torque_sensor_gain", 1.0 + q[0]}, {"force_sensor_gain", 1.0 + q[1]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return std::max(std::abs(q[0]), std::abs(q[1])) > 0.03;
}

}  // namespace

Hypothesis sensor_gain() {
  return {.id = "sensor_gain",
          .component = "sensors",
          .channel = "torque_sensor_Nm",
          .where = Where::time,
          .parameters = {{"torque_relative_error", Kind::amplitude, 1e-3, -0.25, 0.25},
                         {"force_relative_error", Kind::amplitude, 1e-3, -0.25, 0.25}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence =
              "a sensor's gain is off: the torque sensor shows {torque_sensor_gain}, the force sensor {force_sensor_gain} "
              "of the truth",
          .absorbed = true,
          .only_readings = true,
          .confused_with = {"torque_gain_error"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
