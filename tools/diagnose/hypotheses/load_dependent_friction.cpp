// Friction that rises with the load on the nut: F_C and F_S times 1 + c |F|.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector load = view.axis.guide_mass_kg * view.track.table_acceleration_m_per_s2;
  scale(sum.screw_sliding, (1.0 + q[0] * load.array().abs()).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& axis) {
  return {{"friction_per_load", q[0] * axis.ball_screw.coulomb_N.pos}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis load_dependent_friction() {
  return {.id = "load_dependent_friction",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"relative_per_N", Kind::amplitude, 1e-4, 0.0, 1.0}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the screw's friction rises by {friction_per_load} N for each newton on the nut",

          .confused_with = {"torque_gain_error"},
          .friction = true};
}

}  // namespace feedtwin::tools::diagnosis
