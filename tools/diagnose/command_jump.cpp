#include "tools/diagnose/command_jump.h"

#include <algorithm>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

double force_jump_share(const std::vector<Recording>& runs, const plant::AxisParameters& nominal) {
  constexpr double least_s = 3e-4, most_s = 1.45e-3;  // more is a late sensor
  constexpr double beyond_torque_s = 2.5e-4;          // a late command makes both sensors look late
  constexpr int rounds = 2, iterations = 3;
  if (runs.empty() || !runs.front().has(channel::force_sensor_N)) return 1.0;
  const InverseModel one_body(make_tracks(runs, nominal), nominal);
  const Fitter fitter(one_body, nominal);
  const auto& skew = hypothesis("channel_skew");
  auto whitening = fitter.colour_of(one_body.residual(nominal, {}));
  const Fit fit = fitter.fit_with_colour({nominal, {{&skew, {0.0, 0.0}}}}, whitening, rounds, iterations);
  const auto& late_s = fit.model.effects.front().q;
  if (late_s[1] < std::max(least_s, late_s[0] + beyond_torque_s) || late_s[1] > most_s) return 1.0;
  const double half_tick_s = 0.5 * one_body.tracks().front().sample_s;
  return std::max(-1.0, 1.0 - late_s[1] / half_tick_s);
}

}  // namespace feedtwin::tools::diagnosis
