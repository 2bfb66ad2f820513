// Cyclic lead error: the table is ahead by A sin(n theta + phase).

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.slip_m, wave(view.track.position_m, view.transmission().lead_m, q[2], q[0], q[1]));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"amplitude_m", std::hypot(q[0], q[1])}, {"cycles_per_rev", q[2]}, {"phase_rad", std::atan2(q[1], q[0])}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& axis) {
  return wavers_little(std::hypot(q[0], q[1]), q[2], axis.axis);
}

}  // namespace

Hypothesis cyclic_lead_error() {
  return {.id = "cyclic_lead_error",
          .component = "ball_screw",
          .channel = "scale_position_m",
          .where = Where::order,
          .parameters = {{"sine_m", Kind::amplitude, 1e-7},
                         {"cosine_m", Kind::amplitude, 1e-7},
                         {"cycles_per_rev", Kind::fixed, 1.0, 1.0, 100.0}},
          .shapes = whole_orders(1, 4),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the lead wavers by {amplitude_m} m, {cycles_per_rev} times a revolution",

          .confused_with = {"encoder_eccentricity"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
