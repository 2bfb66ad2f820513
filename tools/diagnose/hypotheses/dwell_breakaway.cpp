// Breakaway that rises with the dwell: F_C and F_S times 1 + r (1 - exp(-age / T)), d(age)/dt = 1 - |v| age / D.

#include <cmath>

#include "plant/lanes.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double memory_distance_m = 2e-5, largest_rise = 2.0;

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  Vector factor(track.size);
  double age_s = 0.0;
  for (Index k = 0; k < track.size; ++k) {
    const double worn = std::abs(track.velocity_m_per_s[k]) * track.sample_s / memory_distance_m,
                 left = plant::exp_of_minus(worn);
    age_s = age_s * left + track.sample_s * (worn > 1e-3 ? (1.0 - left) / worn : 1.0 - worn * (0.5 - worn / 6.0));
    factor[k] = 1.0 + q[0] * (1.0 - plant::exp_of_minus(age_s / q[1]));
  }
  scale(sum.screw_sliding, factor);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_rise", q[0]}, {"time_constant_s", q[1]}, {"memory_distance_m", memory_distance_m}};
}

/// A rise that runs to its bound is no rise with the rest: friction about reversals that other laws simplify.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.03 && q[0] < 0.95 * largest_rise;
}

}  // namespace

Hypothesis dwell_breakaway() {
  return {.id = "dwell_breakaway",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::reversal,
          .parameters = {{"relative_rise", Kind::amplitude, 1e-2, 0.0, largest_rise},
                         {"time_constant_s", Kind::shape, 1e-2, 0.01, 20.0}},
          .shapes = {{0.05}, {0.3}, {2.0}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "breakaway rises with the rest before it, by up to {relative_rise} of itself",
          .least_gain = 100.0,  // friction about reversals is modelled worst: 33 to 93 where there was none, true ones 364
          .about_reversals = true,
          .confused_with = {"presliding_memory"},
          .closed_loop_start = {0.3, 1.0},  // about reversals the inverse model has only their ratio, and that roughly
          .friction = true};
}

}  // namespace feedtwin::tools::diagnosis
