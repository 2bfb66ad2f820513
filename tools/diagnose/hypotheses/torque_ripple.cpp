// Torque ripple: T = T_cmd (1 + r sin(n theta + phase)), proportional to the current.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const auto ripple = [&](const Vector& torque_N, const Vector& at_m) -> Vector {
    return torque_N.cwiseProduct(wave(at_m, view.transmission().lead_m, q[2], q[0], q[1]));
  };
  const Vector about = ripple(track.command_N, track.position_m);
  add(sum.drive_N, about);
  add(sum.metered_drive_N, ripple(track.held_N, track.metered_at_m) - about);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_amplitude", std::hypot(q[0], q[1])}, {"cycles_per_rev", q[2]}, {"phase_rad", std::atan2(q[1], q[0])}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return std::hypot(q[0], q[1]) > 1e-3;
}

}  // namespace

Hypothesis torque_ripple() {
  return {.id = "torque_ripple",
          .component = "motor",
          .channel = "torque_cmd_Nm",
          .where = Where::order,
          .parameters = {{"sine", Kind::amplitude, 1e-3},
                         {"cosine", Kind::amplitude, 1e-3},
                         {"cycles_per_rev", Kind::fixed, 1.0, 1.0, 1000.0}},
          .shapes = whole_orders(1, 48),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the torque ripples with the current: {relative_amplitude} of it, {cycles_per_rev} times a revolution",

          .confused_with = {"cogging", "rev_ripple"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
