// Saturation: the drive gives no more than a limit.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const double limit = q[1] * view.track.held_N.cwiseAbs().maxCoeff();
  add(sum.drive_N, q[0] * about_sample((view.track.held_N.cwiseMax(-limit).cwiseMin(limit) - view.track.held_N).eval()));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"share", q[0]}, {"limit_share", q[1]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.5;
}

}  // namespace

Hypothesis torque_saturation() {
  return {.id = "torque_saturation",
          .component = "drive",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"share", Kind::amplitude, 1e-2, 0.0, 1.0}, {"limit_share", Kind::shape, 1e-3, 0.2, 1.0}},
          .shapes = {{0.5}, {0.6}, {0.7}, {0.8}, {0.9}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the drive gives no more than {limit_share} of the largest torque commanded",
          .confused_with = {"torque_gain_error"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
