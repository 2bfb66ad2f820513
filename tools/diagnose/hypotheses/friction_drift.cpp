// Friction that drifts with time, whatever is done: F_C and F_S times 1 + d t.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector t = Vector::LinSpaced(view.track.size, 0.0, static_cast<double>(view.track.size - 1) * view.track.sample_s);
  scale(sum.screw_sliding, (1.0 + q[0] * t.array()).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_rate_per_s", q[0]}};
}

}  // namespace

Hypothesis friction_drift() {
  return {.id = "friction_drift",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"relative_rate_per_s", Kind::amplitude, 1e-3, -0.5, 0.5}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .sentence = "sliding friction drifts by {relative_rate_per_s} of itself a second",
          .confused_with = {"thermal_friction"},
          .friction = true};
}

}  // namespace feedtwin::tools::diagnosis
