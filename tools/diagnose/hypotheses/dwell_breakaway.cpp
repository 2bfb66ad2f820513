// Breakaway that rises with the dwell: F_C and F_S times 1 + r (1 - exp(-age / T)), d(age)/dt = 1 - |v| age / D. It works
// with the first slope r / T, which short rests tell alone, with the rate 1 / T, and with ln(D / 20 um).

#include <cmath>

#include "plant/lanes.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double usual_memory_m = 2e-5, largest_rise = 2.0;
constexpr double slowest_per_s = 0.2;  // slower, and rests of a second or two show a straight line

/// Sliding that renews the contacts.
double memory_distance_m(std::span<const double> q) {
  return usual_memory_m * std::exp(q[2]);
}

/// After so long a rest.
double rise_after(double rest_s, std::span<const double> q) {
  return q[0] / q[1] * (1.0 - plant::exp_of_minus(rest_s * q[1]));
}

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  Vector factor(track.size);
  const double renewed_per_m = track.sample_s / memory_distance_m(q);
  double age_s = 0.0;
  for (Index k = 0; k < track.size; ++k) {
    const double worn = std::abs(track.steady_m_per_s[k]) * renewed_per_m, left = plant::exp_of_minus(worn);
    age_s = age_s * left + track.sample_s * (worn > 1e-3 ? (1.0 - left) / worn : 1.0 - worn * (0.5 - worn / 6.0));
    factor[k] = 1.0 + rise_after(age_s, q);
  }
  scale(OfLaws(view, sum).sliding, factor);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_rise", q[0] / q[1]}, {"time_constant_s", 1.0 / q[1]}, {"memory_distance_m", memory_distance_m(q)}};
}

/// A rise that runs to its bound, or hardly shows after a second, is no rise with the rest: friction about reversals that
/// other laws simplify.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  const double rise = q[0] / q[1];
  return rise > 0.03 && rise < 0.95 * largest_rise && rise_after(1.0, q) > 0.01;
}

/// What is there sooner is friction about reversals too: of six false ones beside slip elements each came to the fastest
/// that is looked for, of the true ones the fastest to 0.08 s.
bool finding(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  constexpr double soonest_s = 0.05;
  return 1.0 / q[1] > soonest_s;
}

}  // namespace

Hypothesis dwell_breakaway() {
  return {.id = "dwell_breakaway",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::reversal,
          .parameters = {{"slope_per_s", Kind::amplitude, 1e-2, 0.0, 100.0},
                         {"rate_per_s", Kind::shape, 1e-2, slowest_per_s, 100.0},
                         {"log_memory", Kind::shape, 0.05, -2.5, 3.2}},
          .shapes = {{20.0, 0.0}, {3.0, 0.0}, {0.5, 0.0}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the {contact}'s breakaway rises with the rest before it, by up to {relative_rise} of itself",
          .least_gain = 100.0,  // friction about reversals is modelled worst: 33 to 93 where there was none, true ones 364
          .about_reversals = true,
          .finding = finding,
          .confused_with = {"presliding_memory"},
          // about reversals the inverse model has only their ratio, and that roughly
          .closed_loop_starts = {{0.3, 1.0, 0.0}},
          .friction = true};
}

}  // namespace feedtwin::tools::diagnosis
