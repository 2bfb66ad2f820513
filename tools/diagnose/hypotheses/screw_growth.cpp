// The screw grows from its fixed bearing as it warms: x + (e + (b - e) exp(-t / T)) (x - x_f), b what a run begins with.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double farthest_bearing_m = 0.5;  // from the middle of the stroke

constexpr std::size_t first_state = 3;

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector t = Vector::LinSpaced(view.track.size, 0.0, static_cast<double>(view.track.size - 1) * view.track.sample_s);
  const double before = q[state_of_run(first_state, view.track.run)];
  const Vector grown = (q[0] + (before - q[0]) * (-t.array() / q[1]).exp()).matrix();
  add(sum.slip_m, (grown.array() * (view.track.position_m.array() - q[2])).matrix());
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"relative_growth", q[0]}, {"time_constant_s", q[1]}, {"fixed_end_m", q[2]}};
}

/// Runs that all begin with what it grows to show a wrong lead, and so does what is over within a second of the first.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  constexpr double as_grown = 0.2, at_once_s = 1.0;
  const auto later = q.subspan(first_state + 1, line_runs - 1);
  const bool any = std::ranges::any_of(later, [](double before) { return before != 0.0; });
  const bool all_grown = std::ranges::all_of(
      later, [&](double before) { return before == 0.0 || std::abs(before - q[0]) < as_grown * std::abs(q[0]); });
  return q[0] > 0.0 && q[1] > at_once_s && !(any && all_grown);
}

}  // namespace

Hypothesis screw_growth() {
  return {.id = "screw_growth",
          .component = "ball_screw",
          .channel = "scale_position_m",
          .where = Where::position,
          .parameters = with_states({{"relative_growth", Kind::amplitude, 1e-7},
                                     {"time_constant_s", Kind::shape, 1e-2, 0.5, 1e4},
                                     {"fixed_end_m", Kind::shape, 1e-4, -farthest_bearing_m, farthest_bearing_m}},
                                    1e-7, -1e-2, 1e-2),
          .shapes = {{2.0, -0.075, 0.0},
                     {5.0, -0.075, 0.0},
                     {15.0, -0.075, 0.0},
                     {100.0, -0.075, 0.0},
                     {5.0, 0.075, 0.0},
                     {100.0, 0.075, 0.0}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the screw grows as it warms, by {relative_growth} of its length after a long time",

          // beside a noisy scale false ones were missed by 9 and 13 nats, right ones by 36 and more
          .least_missed_nats = 20.0,
          .confused_with = {"lead_error"},
          .special_case = "lead_error",
          .state = "initial_growth",
          .first_state = first_state,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
