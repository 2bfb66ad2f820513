// Cogging: T = A sin(n theta + phase), n cycles a revolution, independent of the current.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.motor_N,
      per_lead(view.transmission()) * wave(view.track.position_m, view.transmission().lead_m, q[2], q[0], q[1]));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"amplitude_Nm", std::hypot(q[0], q[1])}, {"cycles_per_rev", q[2]}, {"phase_rad", std::atan2(q[1], q[0])}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return std::hypot(q[0], q[1]) > 1e-4;
}

}  // namespace

Hypothesis cogging() {
  return {.id = "cogging",
          .component = "motor",
          .channel = "torque_cmd_Nm",
          .where = Where::order,
          .parameters = {{"sine_Nm", Kind::amplitude, 1e-3},
                         {"cosine_Nm", Kind::amplitude, 1e-3},
                         {"cycles_per_rev", Kind::fixed, 1.0, 1.0, 1000.0}},
          .shapes = whole_orders(3, 48),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence =
              "the motor cogs: a torque of {amplitude_Nm} N m that repeats {cycles_per_rev} times a revolution whatever the "
              "current",

          .confused_with = {"torque_ripple", "rev_ripple", "encoder_eccentricity"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
