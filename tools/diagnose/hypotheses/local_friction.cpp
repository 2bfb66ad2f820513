// A damaged spot: more friction about one place of the guide, or of the screw.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const auto offset = (view.track.position_m.array() - q[1]) / q[2];
  add(q[3] > 0.5 ? sum.screw_N : sum.guide_N,
      (q[0] * view.track.centred_m_per_s.array().sign() * (-offset.square()).exp()).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"height_N", q[0]}, {"centre_m", q[1]}, {"half_width_m", q[2]}, {"on_screw", q[3]}};
}

/// Wider is friction that varies along the stroke; more than all the axis's own friction again is something solid.
bool possible(std::span<const double> q, const plant::AxisParameters& axis) {
  const auto mean_N = [](const plant::Directional& of) { return 0.5 * (of.pos + of.neg); };
  const double own_N = mean_N(axis.motor.coulomb_N) + mean_N(axis.ball_screw.coulomb_N) + mean_N(axis.guide.coulomb_N);
  return q[0] > 0.0 && q[0] < own_N && q[2] < 0.075 * axis.axis.stroke_m;
}

/// All along the recorded travel, narrow, wider, and a twelfth of it wide; of the screw too where a force sensor tells.
Grid places_of(const std::vector<Track>& runs) {
  const Travel travel = travel_of(runs, &Track::position_m);
  const bool told = std::ranges::any_of(runs, [](const Track& run) { return run.force_sensor_N.size() > 0; });
  const double travel_m = travel.length_m(), narrow_m = std::max(0.002, travel_m / 150.0);
  Grid grid;
  for (const double width_m : {narrow_m, 3.0 * narrow_m, travel_m / 12.0})
    for (int i = 0; i * width_m < travel_m; ++i)
      for (const double on_screw : {0.0, 1.0})
        if (told || on_screw == 0.0) grid.push_back({travel.low_m + i * width_m, width_m, on_screw});
  return grid;
}

}  // namespace

Hypothesis local_friction() {
  return {.id = "local_friction",
          .component = "guide",
          .channel = "torque_cmd_Nm",
          .where = Where::position,
          .parameters = {{"force_N", Kind::amplitude, 0.1},
                         {"position_m", Kind::shape, 1e-4, -10.0, 10.0},
                         {"half_width_m", Kind::shape, 1e-4, 2e-4, 0.2},
                         {"on_screw", Kind::fixed}},
          .shapes = {},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "a damaged spot at {centre_m} m, {half_width_m} m to either side, adds {height_N} N of friction",

          .least_strength = 0.25,
          .least_gain = 100.0,        // one bump of a washboard 53; true ones 1279 and more
          .least_missed_nats = 60.0,  // of thirteen true ones the least 77, a false one beside slip elements 39
          .confused_with = {"position_friction"},
          .shapes_for = places_of,
          .component_for = [](std::span<const double> q) -> std::string_view { return q[3] > 0.5 ? "ball_screw" : "guide"; },
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
