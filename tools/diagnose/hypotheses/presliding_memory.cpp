// Pre-sliding with nonlocal memory: Maxwell-slip elements in parallel, F = sum k e_i with |e_i| <= d_i.

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  constexpr int elements = 8;
  const Track& track = view.track;
  std::array<double, elements> stretched{};
  Vector force(track.size);
  const double stiffness = 2.0 * q[0] / (elements * q[1]);
  for (Index k = 0; k < track.size; ++k) {
    const double moved = k > 0 ? track.position_m[k] - track.position_m[k - 1] : 0.0;
    force[k] = 0.0;
    for (int i = 0; i < elements; ++i) {
      const double limit = q[1] * (i + 0.5) / elements;
      double& e = stretched[static_cast<std::size_t>(i)];
      e = std::clamp(e + moved, -limit, limit);
      force[k] += stiffness * e;
    }
  }
  add(sum.screw_N, force);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"force_N", q[0]}, {"distance_m", q[1]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

/// Over what a bristle itself yields (F_C / sigma0: 1.5 um) it is no more than the bristle's own stiffness; over a few times
/// that, how one bristle simplifies any real contact, of up to what screw and guide have (75 N). Contacts made of eight
/// slipping elements came out as 17 to 49 N over 3 to 6.3 um, of six and 134 to 373 N as 73 to 147 N over 3 to 5.3 um, of a
/// bristle of 6 um as 11 N over 15 um, of one of 300 nulls as 6 N over 26 um; a screw that yields as up to 3.6 N over 10 um
/// and more, what was left of a torque constant as 1.9 N over 13 um; over more than that nothing else has it. Where there is
/// more friction, or a bristle that yields more, so much more is the contact's own; the fit takes what the memory holds from
/// the screw's friction. On a null of stiff Maxwell slip it took 254 of 558 N over 3.2 um: less than half of all friction
/// counts only over more than any of these contacts had.
bool finding(std::span<const double> q, const plant::AxisParameters& axis) {
  constexpr double of_any_contact_N = 60.0, of_a_bristle_m = 3e-6, of_many_elements_m = 6.3e-6;
  constexpr double of_a_yielding_screw_N = 7.0, of_any_contact_m = 1e-5, of_nothing_else_N = 2.0, of_nothing_else_m = 3e-5;
  constexpr double usual_N = 75.0, usual_m = 1.5e-6;
  const double screw_N = mean(axis.ball_screw.coulomb_N), yields_m = (screw_N + q[0]) / axis.ball_screw.stiffness_N_per_m;
  const double others_N = screw_N + mean(axis.guide.coulomb_N);
  const double force_N = q[0] / std::max(1.0, others_N / usual_N);
  const double distance_m = q[1] / std::max(1.0, yields_m / usual_m);
  const double least_m = q[0] > others_N ? of_a_bristle_m : of_many_elements_m;
  return (force_N > of_any_contact_N && q[1] > least_m) ||
         (force_N > of_a_yielding_screw_N && distance_m > of_any_contact_m) ||
         (force_N > of_nothing_else_N && distance_m > of_nothing_else_m);
}

}  // namespace

Hypothesis presliding_memory() {
  return {.id = "presliding_memory",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::reversal,
          .parameters = {{"force_N", Kind::amplitude, 0.1}, {"distance_m", Kind::shape, 1e-7, 1e-7, 1e-3}},
          .shapes = {{2e-6}, {5e-6}, {1e-5}, {3e-5}, {1e-4}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "before it slides, friction remembers more than one bristle can: {force_N} N over {distance_m} m",
          .absorbed = true,
          .about_reversals = true,
          .finding = finding,
          .confused_with = {"backlash", "dwell_breakaway"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
