// Something solid in the way: F = k d + c v beyond a place, d the depth, pushing only back.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const double towards = q[3];
  Vector force = Vector::Zero(track.size);
  for (Index k = 0; k < track.size; ++k) {
    const double depth = towards * (track.table_position_m[k] - q[2]);
    if (depth > 0.0) force[k] = towards * std::max(0.0, q[0] * depth + q[1] * towards * track.table_velocity_m_per_s[k]);
  }
  add(sum.guide_N, force);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"position_m", q[2]}, {"direction", q[3]}, {"stiffness_N_per_m", q[0]}, {"damping_Ns_per_m", q[1]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  constexpr double softest_N_per_m = 300.0;      // softer is a spring
  constexpr double hardest_blow_Ns_per_m = 5e3;  // the blow alone may show: nothing yields before it like this
  return q[0] > softest_N_per_m || q[1] > hardest_blow_Ns_per_m;
}

/// What was struck may stand where no step leads from where the fit looked first: the blow itself lies in between.
std::vector<std::vector<double>> beside(std::span<const double> q) {
  constexpr double damped_over_s = 0.05;
  const bool blow_alone = q[0] < 1.0;
  const double stiffness_N_per_m = blow_alone ? 0.5 * q[1] / damped_over_s : q[0];
  const double damping_Ns_per_m = blow_alone ? 0.5 * q[1] : q[1];
  std::vector<std::vector<double>> starts;
  for (const double further_m : {-4e-4, -2e-4, -1e-4, 1e-4, 2e-4, 4e-4})
    starts.push_back({stiffness_N_per_m, damping_Ns_per_m, q[2] + q[3] * further_m, q[3]});
  return starts;
}

/// Only the ends of the travel can have met something; what is soft, a fifth of it deep.
std::vector<std::vector<double>> ends_of(const std::vector<Track>& runs) {
  const Travel travel = travel_of(runs, &Track::table_position_m);
  Grid grid;
  std::vector<double> depths{5e-5, 1e-4, 2e-4, 4e-4, 8e-4, 1.6e-3, 4e-3, 1e-2};
  for (const double share : {0.05, 0.1, 0.15, 0.2})
    if (share * travel.length_m() > 1.2 * depths.back()) depths.push_back(share * travel.length_m());
  for (const double depth : depths) {
    grid.push_back({travel.high_m - depth, 1.0});
    grid.push_back({travel.low_m + depth, -1.0});
  }
  return grid;
}

}  // namespace

Hypothesis hard_stop() {
  return {.id = "hard_stop",
          .component = "guide",
          .channel = "force_sensor_N",
          .where = Where::position,
          .parameters = {{"stiffness_N_per_m", Kind::amplitude, 1e3, 0.0, 1e8},
                         {"damping_Ns_per_m", Kind::amplitude, 10.0, 0.0, 1e6},
                         {"position_m", Kind::shape, 1e-5, -100.0, 100.0},
                         {"direction", Kind::fixed, 1.0, -1.0, 1.0}},
          .shapes = {},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the table runs against something solid at {position_m} m, {stiffness_N_per_m} N/m stiff",
          .law_error = 0.03,
          .about_reversals = true,
          .confused_with = {"local_friction", "cable_spring"},
          .shapes_for = ends_of,
          .starts_after = beside,
          .jumps = true,  // it is met a sample earlier or later, at full speed
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
