// A damaged spot: more friction about one place of the guide.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const auto offset = (view.track.position_m.array() - q[1]) / q[2];
  add(sum.guide_N, (q[0] * view.track.centred_m_per_s.array().sign() * (-offset.square()).exp()).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"height_N", q[0]}, {"centre_m", q[1]}, {"half_width_m", q[2]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis local_friction() {
  return {.id = "local_friction",
          .component = "guide",
          .channel = "torque_cmd_Nm",
          .where = Where::position,
          .parameters = {{"force_N", Kind::amplitude, 0.1},
                         {"position_m", Kind::shape, 1e-4, -10.0, 10.0},
                         {"half_width_m", Kind::shape, 1e-4, 2e-4, 0.008}},
          .shapes = spots(),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "a damaged spot at {centre_m} m, {half_width_m} m to either side, adds {height_N} N of friction",

          .least_strength = 0.25,
          .confused_with = {"position_friction"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
