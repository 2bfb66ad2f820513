// Cable chain or bellows: F = k (x - neutral), the same in both directions.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.guide_N, (q[0] * view.track.table_position_m.array() + q[1]).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"stiffness_N_per_m", q[0]}, {"neutral_m", q[0] != 0.0 ? -q[1] / q[0] : 0.0}};
}

/// A cable is laid so that it hangs at rest somewhere along the travel (of 24 made ones all within 0.69 of half of it). A
/// constant force moves the neutral point, and what Coulomb friction by direction is off by is one: without this the
/// numbers' tolerance takes a spring of 19 N/m to a point three strokes away.
double unlikely(std::span<const double> q, const plant::AxisParameters& axis) {
  constexpr double deviation_strokes = 0.25, least_N_per_m = 1.0;
  const double stiffness_N_per_m = std::max(q[0], least_N_per_m);
  return (-q[1] / stiffness_N_per_m - axis.axis.stroke_centre_m) / (deviation_strokes * axis.axis.stroke_m);
}

/// What pulls towards a point far beyond the stroke is a constant force.
bool possible(std::span<const double> q, const plant::AxisParameters& axis) {
  constexpr double farthest_strokes = 3.0;
  const double neutral_m = -q[1] / q[0];
  return q[0] > 0.0 && std::abs(neutral_m - axis.axis.stroke_centre_m) < farthest_strokes * axis.axis.stroke_m;
}

}  // namespace

Hypothesis cable_spring() {
  return {
      .id = "cable_spring",
      .component = "guide",
      .channel = "force_sensor_N",
      .where = Where::position,
      .parameters = {{"stiffness_N_per_m", Kind::amplitude, 1.0}, {"offset_N", Kind::amplitude, 0.1}},
      .shapes = {{}},
      .apply = apply,
      .named = named,
      .unlikely = unlikely,
      .admissible = possible,
      .sentence = "a cable or bellows pulls with {stiffness_N_per_m} N/m towards {neutral_m} m, the same in both directions",

      .confused_with = {"position_friction", "gravity"},
      .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
