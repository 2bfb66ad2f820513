// Friction that goes up and down along the stroke: F_C and F_S times 1 + A sin(2 pi (x - x_c) / L + phi).

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  if (q[0] == 0.0 && q[1] == 0.0) return;
  const Vector from_middle = (view.track.position_m.array() - view.transmission().stroke_centre_m).matrix();
  scale(sum.screw_sliding, (1.0 + wave(from_middle, q[2], 1.0, q[0], q[1]).array()).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_amplitude", std::hypot(q[0], q[1])}, {"period_m", q[2]}, {"phase_rad", std::atan2(q[1], q[0])}};
}

/// Shorter waves are the screw's revolutions and what its balls do.
constexpr double least_leads = 2.5;

bool possible(std::span<const double> q, const plant::AxisParameters& axis) {
  return std::hypot(q[0], q[1]) > 0.01 && std::hypot(q[0], q[1]) < 1.5 && q[2] > least_leads * axis.axis.lead_m;
}

/// Half a wave over the travel, a whole one, one and a half: what is between is found from these.
std::vector<std::vector<double>> periods_of(const std::vector<Track>& runs) {
  constexpr int most_halves = 16;
  constexpr double least_period_m = 8e-3;
  double low_m = 1e300, high_m = -1e300;
  for (const auto& run : runs) {
    low_m = std::min(low_m, run.position_m.minCoeff());
    high_m = std::max(high_m, run.position_m.maxCoeff());
  }
  std::vector<std::vector<double>> grid;
  for (int halves = 1; halves <= most_halves; ++halves)
    grid.push_back({std::max(least_period_m, 2.0 * (high_m - low_m) / halves)});
  return grid;
}

}  // namespace

Hypothesis position_friction_wave() {
  return {.id = "position_friction_wave",
          .told_as = "position_friction",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::position,
          .parameters = {{"sine", Kind::amplitude, 1e-2, -1.5, 1.5},
                         {"cosine", Kind::amplitude, 1e-2, -1.5, 1.5},
                         {"period_m", Kind::shape, 1e-5, 4e-3, 10.0}},
          .shapes = {},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence =
              "the screw's friction goes up and down along the stroke, by {relative_amplitude} of its sliding part over "
              "{period_m} m",
          .confused_with = {"local_friction", "cable_spring"},
          .shapes_for = periods_of,
          .friction = true};
}

}  // namespace feedtwin::tools::diagnosis
