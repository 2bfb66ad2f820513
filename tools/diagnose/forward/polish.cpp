#include "tools/diagnose/forward/polish.h"

#include <algorithm>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/unknowns.h"

namespace feedtwin::tools::diagnosis {

Polished polish(const ForwardModel& forward, const Fitter& fitter, const Candidate& start, const PolishSettings& settings) {
  const Unknowns unknowns(fitter, start);
  const Index shared = unknowns.count(settings.known_effects);
  bool known = settings.known != nullptr;
  const BatchSimulator simulator = [&](const ClosedLoopRun& run, const Eigen::MatrixXd& all) {
    const auto place = static_cast<std::size_t>(&run - forward.runs().data());
    const auto simulate = [&](const Eigen::MatrixXd& points) {
      std::vector<plant::AxisParameters> axes;
      for (Index i = 0; i < points.cols(); ++i) axes.push_back(extended(unknowns.at(points.col(i))).of(place));
      return forward.simulate(run, axes);
    };
    auto simulated = known ? settings.known->simulated(place, all, shared, simulate) : simulate(all);
    if (settings.learned != nullptr) settings.learned->learn(place, all, simulated);
    return simulated;
  };
  OutputErrorSettings output_error;
  output_error.prior = 1.0;
  output_error.doubt_rests = false;
  output_error.encoder_grids = 0;
  output_error.torque_sensor_while_sliding = true;
  output_error.largest_deviations = 3.0;
  output_error.rounds = settings.rounds;
  output_error.most_iterations = settings.most_iterations;
  output_error.coloured_from_start = settings.coloured_from_start;
  output_error.intervals = settings.intervals;
  output_error.kept_steps = 2;
  output_error.least_fall = settings.least_fall_nats;
  output_error.behind_nats = settings.behind_nats;
  if (settings.known_to_begin_with) output_error.round_begins = [&](int round) { known = known && round == 0; };
  if (settings.least_promise_nats > 0.0) {
    output_error.asked = unknowns.count(start.effects.size()) - unknowns.count(start.effects.size() - 1);
    output_error.least_promise = settings.least_promise_nats;
  }
  const auto fit = fit_output_error(forward.runs(), unknowns.parameters(), simulator, output_error);
  const bool moved = std::ranges::any_of(
      fit.parameters, [](const FittedParameter& p) { return p.value != p.parameter.start.value_or(p.parameter.nominal); });
  Polished polished{unknowns.at(fit.point()), {}, fit.cost, moved};
  if (fit.covariance.size() > 0) polished.covariance = Unknowns(fitter, polished.model).as_of_fit(fit.covariance);
  return polished;
}

}  // namespace feedtwin::tools::diagnosis
