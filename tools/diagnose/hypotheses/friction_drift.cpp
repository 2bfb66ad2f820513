// Friction that drifts with time, whatever is done: F_C, F_S and mu times 1 + c + (b - c) exp(-t / T), b what a run begins
// with: lubrication and wear go on between sessions.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t first_state = 2;
constexpr double least_step = 0.02;  ///< between sessions

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector t = Vector::LinSpaced(view.track.size, 0.0, static_cast<double>(view.track.size - 1) * view.track.sample_s);
  const double before = q[state_of_run(first_state, view.track.run)];
  const Vector factor = (1.0 + q[0] + (before - q[0]) * (-t.array() / q[1]).exp()).matrix();
  const OfLaws contact(view, sum);
  scale(contact.sliding, factor);
  scale(contact.viscous, factor);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_change", q[0]}, {"time_constant_s", q[1]}};
}

/// What a recording shows of it, or what happened between them. What is over with the first move, in each run anew, is no
/// lubricant's doing: the screw warms, or friction at rest is another (of a screw that warmed it made 3 % within 0.4 s).
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  constexpr double a_recording_s = 10.0, least_change = 0.005, a_move_s = 1.0;
  if (q[1] < a_move_s) return false;
  const auto [low, high] = std::ranges::minmax(q.subspan(first_state));
  return std::abs(q[0]) * (1.0 - std::exp(-a_recording_s / q[1])) > least_change || high - low > least_step;
}

}  // namespace

Hypothesis friction_drift() {
  return {.id = "friction_drift",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = with_states(
              {{"relative_change", Kind::amplitude, 1e-2, -0.9, 5.0}, {"time_constant_s", Kind::shape, 1e-2, 0.2, 1e4}},
              1e-2, -0.9, 5.0),
          .shapes = {{1.0, 0.0}, {4.0, 0.0}, {20.0, 0.0}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the {contact}'s friction drifts with time, by {relative_change} of itself within {time_constant_s} s",

          // beside a real contact's friction false ones were missed by 3 and 50 nats, right ones by 709 and more
          .least_missed_nats = 150.0,
          .follows_any_law = true,
          .least_deviations = deviations_of_numbers,
          .confused_with = {"thermal_friction", "thermal_friction_of_all"},
          .state = "initial_change",
          .first_state = first_state,
          .clear_step = least_step,
          .friction = true};
}

}  // namespace feedtwin::tools::diagnosis
