// Saturation: the drive gives no more than a limit.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const double limit = q[1] * per_lead(view.transmission());
  add(sum.drive_N, q[0] * about_sample((view.track.held_N.cwiseMax(-limit).cwiseMin(limit) - view.track.held_N).eval()));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"limit_Nm", q[1]}};
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
          .parameters = {{"share", Kind::amplitude, 1e-2, 0.0, 1.3}, {"limit_Nm", Kind::shape, 1e-3, 1e-3, 1e4}},
          .shapes = torque_limits(),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the drive gives no more than {limit_Nm} N m",

          .about_reversals = true,
          .confused_with = {"torque_gain_error"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
