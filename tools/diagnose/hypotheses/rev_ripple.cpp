// Ball-pass or once-a-revolution ripple of the screw: F = A sin(n theta + phase), n rarely whole.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.screw_N, wave(view.track.position_m, view.axis.axis.lead_m, q[2], q[0], q[1]));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"amplitude_N", std::hypot(q[0], q[1])}, {"cycles_per_rev", q[2]}, {"phase_rad", std::atan2(q[1], q[0])}};
}

/// A whole number above two is the motor's: poles and slots.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[2] < 2.05 || std::abs(q[2] - std::round(q[2])) > 0.02;
}

}  // namespace

Hypothesis rev_ripple() {
  return {.id = "rev_ripple",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::order,
          .parameters = {{"sine_N", Kind::amplitude, 0.1},
                         {"cosine_N", Kind::amplitude, 0.1},
                         {"cycles_per_rev", Kind::shape, 1e-3, 0.2, 40.0}},
          .shapes = ripple_orders(),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the screw runs unevenly: {amplitude_N} N, {cycles_per_rev} times a revolution",

          .confused_with = {"cogging", "torque_ripple", "encoder_eccentricity"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
