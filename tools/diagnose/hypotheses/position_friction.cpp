// Friction that varies along the stroke: F_C and F_S times 1 + s (x - centre) / (stroke / 2).

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const auto& axis = view.axis.axis;
  const Vector share = (view.track.position_m.array() - axis.stroke_centre_m).matrix() / (0.5 * axis.stroke_m);
  scale(sum.screw_sliding, (1.0 + q[0] * share.array()).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_slope_per_half_stroke", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return std::abs(q[0]) > 0.005;
}

}  // namespace

Hypothesis position_friction() {
  return {.id = "position_friction",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::position,
          .parameters = {{"relative_slope_per_half_stroke", Kind::amplitude, 1e-2, -3.0, 3.0}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence =
              "the screw's sliding friction grows along the stroke, by {relative_slope_per_half_stroke} of itself from the "
              "middle to the end",

          .confused_with = {"cable_spring", "local_friction"},
          .friction = true};
}

}  // namespace feedtwin::tools::diagnosis
