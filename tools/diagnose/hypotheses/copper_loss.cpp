// Copper loss: P = c T^2, also at standstill.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const double k = per_lead(view.transmission());
  add(sum.power_W, q[0] / (k * k) * view.track.held_N.cwiseAbs2());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"coefficient_W_per_Nm2", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis copper_loss() {
  return {.id = "copper_loss",
          .component = "power",
          .channel = "power_W",
          .where = Where::time,
          .parameters = {{"coefficient_W_per_Nm2", Kind::amplitude, 0.1, 0.0, 1e5}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the windings' i^2 R loss is missing: {coefficient_W_per_Nm2} W per N^2 m^2 of torque",
          // beside a force sensor that bends a false one was missed by 1, true ones by 267 and more
          .least_missed_nats = 20.0,
          // beside friction of another law a false one had 0.6, true ones 31 and more
          .least_deviations = 5.0,
          .confused_with = {"regeneration_clipped"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
