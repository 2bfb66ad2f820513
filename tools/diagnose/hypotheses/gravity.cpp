// Gravity or a counterbalance: a constant force on the table.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.guide_N, Vector::Constant(view.track.size, q[0]));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"force_N", q[0]}};
}

}  // namespace

Hypothesis gravity() {
  return {.id = "gravity",
          .component = "guide",
          .channel = "force_sensor_N",
          .where = Where::time,
          .parameters = {{"force_N", Kind::amplitude, 0.1}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .sentence = "a constant {force_N} N acts on the table against positive motion",
          .number_of_the_model = true,
          .absorbed = true,
          // eight true ones 1576 and more, and one of 1.6 N 448; false ones 1 and, without it the
          // numbers 23 squared tolerances nearer to nominal, 474
          .least_missed_nats = 150.0,
          .least_deviations = deviations_of_numbers,
          .confused_with = {"torque_offset", "cable_spring", "direction_dependent_friction"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
