// Viscous friction that grows more slowly than speed: mu v_r (|v| / v_r)^a in place of mu v; q = 1 - a.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  constexpr double reference_m_per_s = 0.1, small_m_per_s = 1e-4;
  const Track& track = view.track;
  const auto& mu = view.contact_of_laws().viscous_Ns_per_m;
  Vector force(track.size);
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.centred_m_per_s[k];
    const double share = std::hypot(v, small_m_per_s) / reference_m_per_s;
    force[k] = (v > 0.0 ? mu.pos : mu.neg) * v * (std::pow(share, -q[0]) - 1.0);
  }
  add(OfLaws(view, sum).resists_N, force);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"exponent", 1.0 - q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.01;  // above one it is drag
}

}  // namespace

Hypothesis sublinear_viscous() {
  return {.id = "sublinear_viscous",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::velocity,
          .parameters = {{"exponent_below_one", Kind::amplitude, 1e-2, 0.0, 0.75}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the {contact}'s viscous friction grows as the speed to the power {exponent}",
          .law_of_speed = true,
          // of twelve names in seventeen sets the true ones had 11 and more, a false one beside a delay 1.4
          .least_deviations = 5.0,
          .confused_with = {"quadratic_drag", "direction_dependent_friction"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
