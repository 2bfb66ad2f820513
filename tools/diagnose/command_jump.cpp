#include "tools/diagnose/command_jump.h"

#include <algorithm>
#include <numbers>
#include <string_view>

#include "tools/diagnose/fit.h"
#include "tools/diagnose/shown_shift.h"

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

/// The recordings read behind a screw that yields. @param share as it is returned
struct YieldingScrew {
  InverseModel model;
  Fit fit;

  YieldingScrew(const std::vector<Recording>& runs, const plant::AxisParameters& nominal, double share)
      : model(make_tracks(runs, nominal, {.jump_shares = {.force = share}}), nominal),
        fit(quickly_fitted(model, {nominal, {}})) {}
};

/// The recordings read as one body with sensors that are late.
struct OneBody {
  InverseModel model;
  Fit fit;

  OneBody(const std::vector<Recording>& runs, const plant::AxisParameters& nominal)
      : model(make_tracks(runs, nominal), nominal),
        fit(quickly_fitted(model, {nominal, {{&hypothesis("channel_skew"), {0.0, 0.0}}}})) {}

  [[nodiscard]] double torque_late_s() const { return fit.model.effects.front().q[0]; }
  [[nodiscard]] double force_late_s() const { return fit.model.effects.front().q[1]; }
  [[nodiscard]] double half_tick_s() const { return 0.5 * model.tracks().front().sample_s; }
};

constexpr double clearly_late_s = 1.5e-4;  ///< a command

/// Without a torque sensor a late command is told by what it leaves over.
bool late_command_leaves_less(const OneBody& one, const YieldingScrew& yielding, const plant::AxisParameters& nominal) {
  // two late by 0.2 and 0.36 ms left 627 and 334 less than a screw that yields would; of 18 others one that looked late at
  // all left 7 less, the rest more
  constexpr double clearly_less = 100.0;
  const Fit late = quickly_fitted(one.model, {nominal, {{&hypothesis("input_delay"), {0.0}}}});
  return late.model.effects.back().q[0] > clearly_late_s && late.cost < yielding.fit.cost - clearly_less;
}

double force_share(const OneBody& one, const std::vector<Recording>& runs, const plant::AxisParameters& nominal,
                   bool with_torque) {
  constexpr double least_s = 3e-4, most_s = 1.45e-3;  // more is a late sensor
  constexpr double beyond_torque_s = 2.5e-4;          // a late command makes both sensors look late
  // of 55 that yield, of five simulators, a late sensor left 0.92 (N rms) and more of what the yielding left; of two that
  // were late 0.77 and 0.84, of a third 0.97
  constexpr double late_leaves_less = 0.88;
  const double late_s = one.force_late_s();
  if (late_s < std::max(least_s, one.torque_late_s() + beyond_torque_s) || late_s > most_s) return 1.0;
  const double share = std::max(-1.0, 1.0 - late_s / one.half_tick_s());
  const YieldingScrew yielding(runs, nominal, share);
  const double late = left_on_the_table(one.model, one.fit), yields = left_on_the_table(yielding.model, yielding.fit);
  if (late < late_leaves_less * late_leaves_less * yields) return 1.0;
  return !with_torque && late_command_leaves_less(one, yielding, nominal) ? 1.0 : share;
}

/// Behind a screw that yields the jump moves motor and screw alone.
double torque_share_of_a_yielding_screw(const plant::AxisParameters& axis) {
  const double rad_per_m = 2.0 * std::numbers::pi / axis.axis.lead_m, motor = axis.motor.inertia_kgm2,
               screw = axis.ball_screw_inertia_kgm2, table = axis.guide_mass_kg / (rad_per_m * rad_per_m);
  return screw / (motor + screw) * (motor + screw + table) / (screw + table);
}

/// Sensors that are read before the row's command sets in show the sample's last instant under the command before: as late
/// again as what they do not show of the jump, and no more than a sample.
/// @param behind the torque sensor's share of a jump behind a screw that yields
bool as_late_as_before_the_command(const OneBody& one, double behind) {
  // three that were read so behind screws that yield looked 1.7 to 1.8 half ticks late, two on rigid axes 1.6 and 1.9
  constexpr double least = 0.92, most = 2.15, of_at_once = 1.6;
  const double half_ticks = one.torque_late_s() / one.half_tick_s();
  return half_ticks > std::max(least * (1.0 + behind), of_at_once * (1.0 - behind) + 0.2) && half_ticks < most;
}

/// Both are: one that shows the jump at once was read after it, and the other is late by itself.
bool force_sensor_is_late_too(const OneBody& one) {
  constexpr double least = 0.5;  // half ticks; 1.0 behind a screw that yields, 1.6 and more on rigid axes
  return one.force_late_s() > least * one.half_tick_s();
}

/// However late a motor's friction that sets in over a path lets the torque sensor look.
bool shown_by_its_jumps(const OneBody& one) {
  return shown_a_sample_later(shown_shift(one.model.tracks(), &Track::torque_sensor_N));
}

/// A command that is late makes all sensors look so; it is late for the motion too.
bool command_is_late(const OneBody& one, const plant::AxisParameters& nominal) {
  // of drives whose current follows within 50 us, as most do, the motion looked 46 to 96 us late; of one late by 125 us, 129
  constexpr double late_for_the_motion_s = 1.1e-4;
  const Fit fit =
      quickly_fitted(one.model, {nominal, {{&hypothesis("channel_skew"), {0.0, 0.0}}, {&hypothesis("input_delay"), {0.0}}}});
  return fit.model.effects.back().q[0] > late_for_the_motion_s;
}

/// By how late each looks: as it does behind a screw that swings too.
JumpShares shares_before_the_command(const OneBody& one, bool with_force) {
  const auto share = [&](double late_s) { return std::max(-1.0, 1.0 - late_s / one.half_tick_s()); };
  return {
      .torque = share(one.torque_late_s()), .force = with_force ? share(one.force_late_s()) : 1.0, .before_command = true};
}

/// As late as the torque sensor looks, read as one body, where the jump moves motor and screw alone.
bool as_late_as_behind_a_yielding_screw(const OneBody& one, double share) {
  // two behind a yielding screw looked 1.05 and 1.3 times as late, one with a lag of 50 us too 3.9
  constexpr double least_of_late = 0.5, most_of_late = 1.6;
  const double looks_late_s = (1.0 - share) * one.half_tick_s();
  return one.torque_late_s() > least_of_late * looks_late_s && one.torque_late_s() < most_of_late * looks_late_s;
}

}  // namespace

JumpShares jump_shares(const std::vector<Recording>& runs, const plant::AxisParameters& nominal) {
  // where it is 0.85 and more a sensor looks as late for other reasons: 10 of 28 records
  constexpr double most_that_tells = 0.8;
  const double behind = torque_share_of_a_yielding_screw(nominal);
  const auto recorded = [&](std::string_view sensor) { return !runs.empty() && runs.front().has(sensor); };
  const bool by_force = recorded(channel::force_sensor_N), with_torque = recorded(channel::torque_sensor_Nm),
             by_torque = with_torque && behind < most_that_tells;
  if (!by_force && !with_torque) return {};
  const OneBody one(runs, nominal);
  if (with_torque && (!by_force || force_sensor_is_late_too(one)) &&
      (as_late_as_before_the_command(one, behind) || shown_by_its_jumps(one)) && !command_is_late(one, nominal))
    return shares_before_the_command(one, by_force);
  const double force = by_force ? force_share(one, runs, nominal, with_torque) : 1.0;
  const bool yields = force < 1.0 || (by_torque && as_late_as_behind_a_yielding_screw(one, behind));
  return {.torque = yields ? behind : 1.0, .force = force};
}

}  // namespace feedtwin::tools::diagnosis
