#include "tools/diagnose/command_jump.h"

#include <algorithm>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

namespace {

Fit quickly_fitted(const InverseModel& model, const Candidate& start) {
  constexpr int rounds_of_colour = 2, steps_a_round = 3;
  const Fitter fitter(model, start.axis);
  auto whitening = fitter.colour_of(model.residual(start.axis, {}));
  return fitter.fit_with_colour(start, whitening, rounds_of_colour, steps_a_round);
}

/// Of the table's own equation, (N)^2.
double left_on_the_table(const InverseModel& model, const Fit& fit) {
  double squares = 0.0;
  for (const auto& s : model.segments())
    if (tables_own(model.equations()[s.equation])) squares += fit.residual.segment(s.start, s.size).squaredNorm();
  return squares;
}

/// What a screw that yields leaves over of the table's force. @param share as it is returned
double left_behind_a_screw_that_yields(const std::vector<Recording>& runs, const Candidate& start, double share) {
  const InverseModel model(make_tracks(runs, start.axis, {.force_jump_share = share}), start.axis);
  return left_on_the_table(model, quickly_fitted(model, start));
}

}  // namespace

double force_jump_share(const std::vector<Recording>& runs, const plant::AxisParameters& nominal) {
  constexpr double least_s = 3e-4, most_s = 1.45e-3;  // more is a late sensor
  constexpr double beyond_torque_s = 2.5e-4;          // a late command makes both sensors look late
  // of 55 that yield, of five simulators, a late sensor left 0.92 (N rms) and more of what the yielding left; of two that
  // were late 0.77 and 0.84, of a third 0.97
  constexpr double late_leaves_less = 0.88;
  if (runs.empty() || !runs.front().has(channel::force_sensor_N)) return 1.0;
  const InverseModel one_body(make_tracks(runs, nominal), nominal);
  const auto& skew = hypothesis("channel_skew");
  const Fit fit = quickly_fitted(one_body, {nominal, {{&skew, {0.0, 0.0}}}});
  const auto& late_s = fit.model.effects.front().q;
  if (late_s[1] < std::max(least_s, late_s[0] + beyond_torque_s) || late_s[1] > most_s) return 1.0;
  const double half_tick_s = 0.5 * one_body.tracks().front().sample_s;
  const double share = std::max(-1.0, 1.0 - late_s[1] / half_tick_s);
  const double late = left_on_the_table(one_body, fit), yields = left_behind_a_screw_that_yields(runs, {nominal, {}}, share);
  return late < late_leaves_less * late_leaves_less * yields ? 1.0 : share;
}

}  // namespace feedtwin::tools::diagnosis
