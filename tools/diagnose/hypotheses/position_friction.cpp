// Friction that varies along the stroke: F_C and F_S times 1 + s u, mu+ + e+ u, mu- + e- u, u = (x - centre) / (stroke / 2).

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double least_left = 0.01;  // of sliding friction, as the plant has it
/// More would turn friction round within the stroke: on two laps of the EMPS axis -3 times the small part that was the
/// screw's stood for what its other numbers say.
constexpr double most_slope = 1.5;

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const auto& axis = view.transmission();
  const Vector share = (view.track.position_m.array() - axis.stroke_centre_m).matrix() / (0.5 * axis.stroke_m);
  const OfLaws contact(view, sum);
  scale(contact.sliding, (1.0 + q[0] * share.array()).max(least_left).matrix());
  const auto v = view.track.centred_m_per_s.array();
  add(contact.resists_N, (share.array() * (q[1] * v.max(0.0) + q[2] * v.min(0.0))).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_slope_per_half_stroke", q[0]},
          {"viscous_slope_forth_Ns_per_m", q[1]},
          {"viscous_slope_back_Ns_per_m", q[2]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& axis) {
  constexpr double least_share_of_viscous = 0.02;
  const auto& mu = axis.contact_of_laws().viscous_Ns_per_m;
  return std::abs(q[0]) > 0.005 || std::abs(q[1]) > least_share_of_viscous * mu.pos ||
         std::abs(q[2]) > least_share_of_viscous * mu.neg;
}

}  // namespace

Hypothesis position_friction() {
  return {
      .id = "position_friction",
      .component = "ball_screw",
      .channel = "torque_cmd_Nm",
      .where = Where::position,
      .parameters = {{"relative_slope_per_half_stroke", Kind::amplitude, 1e-2, -most_slope, most_slope},
                     {"viscous_slope_forth_Ns_per_m", Kind::amplitude, 1.0},
                     {"viscous_slope_back_Ns_per_m", Kind::amplitude, 1.0}},
      .shapes = {{}},
      .apply = apply,
      .named = named,
      .admissible = possible,
      .sentence =
          "the {contact}'s friction grows along the stroke, from the middle to the end its sliding part by "
          "{relative_slope_per_half_stroke} of itself, its viscous part by {viscous_slope_forth_Ns_per_m} N s/m forth and "
          "{viscous_slope_back_Ns_per_m} N s/m back",
      .confused_with = {"cable_spring", "local_friction"},
      .friction = true,
      .forces_too = true};
}

}  // namespace feedtwin::tools::diagnosis
