// Friction that drifts with time, whatever is done: F_C, F_S and mu times 1 + c (1 - exp(-t / T)).

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector t = Vector::LinSpaced(view.track.size, 0.0, static_cast<double>(view.track.size - 1) * view.track.sample_s);
  const Vector factor = (1.0 + q[0] * (1.0 - (-t.array() / q[1]).exp())).matrix();
  scale(sum.screw_sliding, factor);
  scale(sum.screw_viscous, factor);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_change", q[0]}, {"time_constant_s", q[1]}};
}

/// What a recording shows of it.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  constexpr double a_recording_s = 10.0, least_change = 0.005;
  return std::abs(q[0]) * (1.0 - std::exp(-a_recording_s / q[1])) > least_change;
}

}  // namespace

Hypothesis friction_drift() {
  return {.id = "friction_drift",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"relative_change", Kind::amplitude, 1e-2, -0.9, 5.0},
                         {"time_constant_s", Kind::shape, 1e-2, 0.2, 1e4}},
          .shapes = {{1.0}, {4.0}, {20.0}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "friction drifts with time, by {relative_change} of itself within {time_constant_s} s",

          .confused_with = {"thermal_friction"},
          .friction = true};
}

}  // namespace feedtwin::tools::diagnosis
