// The screw grows as it warms: the lead rises with the time run.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector t = Vector::LinSpaced(view.track.size, 0.0, static_cast<double>(view.track.size - 1) * view.track.sample_s);
  add(sum.slip_m, (q[0] / 600.0 * t.array() * (view.track.position_m.array() + 0.075)).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_growth", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis screw_growth() {
  return {.id = "screw_growth",
          .component = "ball_screw",
          .channel = "scale_position_m",
          .where = Where::position,
          .parameters = {{"relative_rate_per_s", Kind::amplitude, 1e-7}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the screw grows as it warms, by {relative_growth} of its length after a long time",

          .confused_with = {"lead_error"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
