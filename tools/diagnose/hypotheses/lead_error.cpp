// Cumulative lead error: the table travels (1 + e) times what the screw says.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.slip_m, (q[0] * view.track.position_m.array() + q[1]).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_error", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return std::abs(q[0]) > 3e-6;
}

}  // namespace

Hypothesis lead_error() {
  return {.id = "lead_error",
          .component = "ball_screw",
          .channel = "scale_position_m",
          .where = Where::position,
          .parameters = {{"relative_error", Kind::amplitude, 1e-5}, {"zero_m", Kind::amplitude, 1e-7}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the lead is off by {relative_error} of itself",

          .confused_with = {"screw_growth"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
