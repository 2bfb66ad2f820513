// Offset of the drive: a constant torque.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.drive_N, Vector::Constant(view.track.size, q[0] * per_lead(view.transmission())));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"offset_Nm", q[0]}};
}

}  // namespace

Hypothesis torque_offset() {
  return {.id = "torque_offset",
          .component = "drive",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"offset_Nm", Kind::amplitude, 1e-3}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .sentence = "the drive adds a constant {offset_Nm} N m",
          .absorbed = true,
          .far_off_gain = 150.0,
          .least_deviations = deviations_of_numbers,
          .confused_with = {"gravity", "direction_dependent_friction"},
          .closed_loop_starts = {{0.0}},
          .told_by_runs_nats = 100.0,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
