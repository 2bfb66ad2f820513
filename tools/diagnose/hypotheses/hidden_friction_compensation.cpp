// The drive compensates friction behind the command: T = T_cmd + T_c tanh(v / v_0).

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.drive_N, q[0] * per_lead(view.axis) * (view.track.centred_m_per_s.array() / q[1]).tanh().matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"torque_Nm", q[0]}, {"speed_m_per_s", q[1]}};
}

}  // namespace

Hypothesis hidden_friction_compensation() {
  return {.id = "hidden_friction_compensation",
          .component = "drive",
          .channel = "torque_cmd_Nm",
          .where = Where::velocity,
          .parameters = {{"torque_Nm", Kind::amplitude, 1e-3}, {"speed_m_per_s", Kind::shape, 1e-5, 1e-5, 1.0}},
          .shapes = {{3e-4}, {1e-3}, {5e-3}, {2e-2}},
          .apply = apply,
          .named = named,
          .sentence = "the drive compensates friction by itself: it adds {torque_Nm} N m in the direction of motion",
          .absorbed = true,
          .confused_with = {"torque_offset", "direction_dependent_friction"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
