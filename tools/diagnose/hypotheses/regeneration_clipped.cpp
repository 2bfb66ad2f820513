// Regeneration clipped: the meter shows nothing where the drive gives power back.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.power_W, q[0] * (-view.base().power_W).cwiseMax(0.0));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"share", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.7;
}

}  // namespace

Hypothesis regeneration_clipped() {
  return {.id = "regeneration_clipped",
          .component = "power",
          .channel = "power_W",
          .where = Where::time,
          .parameters = {{"share", Kind::amplitude, 1e-2, 0.0, 1.0}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "power given back is not seen: {share} of it is clipped",

          .confused_with = {"copper_loss"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
