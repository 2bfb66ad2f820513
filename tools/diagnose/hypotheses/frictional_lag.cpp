// Frictional lag: sliding friction follows speed after a time.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector now = view.base.screw_N;
  add(sum.screw_N, lagged(now, q[0] / view.track.sample_s) - now);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"time_constant_s", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 8e-4;
}

}  // namespace

Hypothesis frictional_lag() {
  return {.id = "frictional_lag",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"time_constant_s", Kind::amplitude, 1e-3, 0.0, 0.2}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "friction follows speed with a lag of {time_constant_s} s",

          .confused_with = {"input_delay", "current_loop_lag"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
