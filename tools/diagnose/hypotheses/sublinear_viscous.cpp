// Viscous friction that grows more slowly than speed: F = c |v|^a.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const auto v = view.track.centred_m_per_s.array();
  add(sum.screw_N, (q[0] * v.sign() * v.abs().pow(q[1])).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"coefficient", q[0]}, {"exponent", q[1]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis sublinear_viscous() {
  return {.id = "sublinear_viscous",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::velocity,
          .parameters = {{"coefficient", Kind::amplitude, 1.0}, {"exponent", Kind::shape, 1e-3, 0.3, 0.97}},
          .shapes = {{0.5}, {0.6}, {0.7}, {0.8}, {0.9}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the screw's viscous friction grows more slowly than speed, as |v|^{exponent}",
          .confused_with = {"quadratic_drag", "direction_dependent_friction"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
