// A damaged spot: more friction about one place.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const auto offset = (view.track.position_m.array() - q[1]) / q[2];
  add(sum.screw_N, (q[0] * view.track.centred_m_per_s.array().sign() * (-0.5 * offset.square()).exp()).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"force_N", q[0]}, {"position_m", q[1]}, {"width_m", q[2]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis local_friction() {
  return {.id = "local_friction",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::position,
          .parameters = {{"force_N", Kind::amplitude, 0.1},
                         {"position_m", Kind::shape, 1e-4, -10.0, 10.0},
                         {"width_m", Kind::shape, 1e-4, 2e-4, 0.05}},
          .shapes = spots(),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "a damaged spot at {position_m} m, {width_m} m wide, adds {force_N} N of friction",
          .confused_with = {"position_friction"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
