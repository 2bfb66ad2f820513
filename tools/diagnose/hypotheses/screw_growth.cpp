// The screw grows as it warms: the lead rises with the time run.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector t = Vector::LinSpaced(view.track.size, 0.0, static_cast<double>(view.track.size - 1) * view.track.sample_s);
  add(sum.slip_m, q[0] * t.cwiseProduct(view.track.position_m));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_rate_per_s", q[0]}};
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
          .sentence = "the screw grows by {relative_rate_per_s} of its length a second",
          .confused_with = {"lead_error"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
