// Breakaway that rises with the dwell: more force over the first micrometres after a rest.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  Vector force(track.size);
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.centred_m_per_s[k];
    const double aged = 1.0 - std::exp(-track.dwell_s[k] / q[1]);
    force[k] =
        q[0] * aged * std::tanh(v / standstill_m_per_s) * std::exp(-std::abs(v) / view.axis.ball_screw.stribeck_m_per_s.pos);
  }
  add(sum.screw_N, force);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& axis) {
  return {{"relative_rise", q[0] / axis.ball_screw.coulomb_N.pos}, {"time_constant_s", q[1]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis dwell_breakaway() {
  return {.id = "dwell_breakaway",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::reversal,
          .parameters = {{"force_N", Kind::amplitude, 0.1}, {"time_constant_s", Kind::shape, 1e-2, 0.01, 20.0}},
          .shapes = {{0.05}, {0.3}, {2.0}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "breakaway rises with the rest before it, by up to {relative_rise} of itself",

          .confused_with = {"presliding_memory"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
