// Payload: more mass on the table, acceleration only.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& /*view*/, std::span<const double> q, Contribution& sum) {
  sum.table_mass_kg += q[0];
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"mass_kg", q[0]}};
}

/// A fifth of the table is a table of another mass; more than ten times what the drive moves by itself is something solid.
bool possible(std::span<const double> q, const plant::AxisParameters& axis) {
  const double inertia_kgm2 = axis.motor.inertia_kgm2 + axis.ball_screw_inertia_kgm2;
  return q[0] > 0.2 * axis.guide_mass_kg &&
         q[0] < 10.0 * (axis.guide_mass_kg + inertia_kgm2 * per_lead(axis.axis) * per_lead(axis.axis));
}

}  // namespace

Hypothesis payload() {
  return {.id = "payload",
          .component = "guide",
          .channel = "force_sensor_N",
          .where = Where::time,
          .parameters = {{"mass_kg", Kind::amplitude, 0.1}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the table carries {mass_kg} kg more than the model says",
          .number_of_the_model = true,
          .absorbed = true,
          .far_off_gain = 35.0,
          .least_deviations = deviations_of_numbers,
          .confused_with = {"current_loop_lag"},
          .closed_loop_starts = {{0.0}},
          .told_by_runs_nats = 100.0,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
