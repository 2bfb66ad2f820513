// Power meter: its window ends earlier than it says.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.power_W, delayed(view.base.power_W, q[0] / view.track.sample_s) - view.base.power_W);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"window_s", 0.1 + 2.0 * q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 5e-3;
}

}  // namespace

Hypothesis power_meter_window() {
  return {.id = "power_meter_window",
          .component = "power",
          .channel = "power_W",
          .where = Where::time,
          .parameters = {{"delay_s", Kind::amplitude, 1e-3, 0.0, 0.5}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the power meter averages over {window_s} s",

          .confused_with = {"regeneration_clipped"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
