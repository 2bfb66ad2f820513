// Saturation: the drive gives no more than a limit.

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector& held_N = view.track.held_N;
  add(sum.drive_N, q[0] * about_sample((held_N.cwiseMax(-q[1]).cwiseMin(q[1]) - held_N).eval()));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& axis) {
  return {{"limit_Nm", q[1] / per_lead(axis.axis)}};
}

/// Below the largest command: near it in small steps, since a limit that is met for some milliseconds only shows there.
Grid limits_of(const std::vector<Track>& runs) {
  double largest_N = 0.0;
  for (const auto& run : runs) largest_N = std::max(largest_N, run.held_N.cwiseAbs().maxCoeff());
  Grid grid{{0.98 * largest_N}, {0.95 * largest_N}};
  for (double share = 0.9; share > 0.02; share *= 0.89)  // NOLINT(bugprone-float-loop-counter): the last is of no matter
    grid.push_back({share * largest_N});
  return grid;
}

double mean_of(const plant::Directional& friction_N) {
  return 0.5 * (friction_N.pos + friction_N.neg);
}

/// A drive that can't overcome the axis's friction would not have moved it; the friction's numbers may be as far off as
/// this.
bool possible(std::span<const double> q, const plant::AxisParameters& axis) {
  constexpr double least_of_friction = 0.5;
  const double friction_N =
      mean_of(axis.motor.coulomb_N) + mean_of(axis.ball_screw.coulomb_N) + mean_of(axis.guide.coulomb_N);
  return q[0] > 0.5 && q[1] > least_of_friction * friction_N;
}

}  // namespace

Hypothesis torque_saturation() {
  return {.id = "torque_saturation",
          .component = "drive",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"share", Kind::amplitude, 1e-2, 0.0, 1.3}, {"limit_N", Kind::shape, 1.0, 1.0, 1e7}},
          .shapes = {},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the drive gives no more than {limit_Nm} N m",
          // its share of what is beyond the limit is no number of the closed loop, which has all of it
          .least_deviations = 0.0,

          .about_reversals = true,
          .confused_with = {"torque_gain_error"},
          .shapes_for = limits_of,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
