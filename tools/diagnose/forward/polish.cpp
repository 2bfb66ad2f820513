#include "tools/diagnose/forward/polish.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/diagnose/forward/extended_axis.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// In units of an effect's scale: wide, but where only a combination of its numbers tells, the others stay in sight of it.
constexpr double hardly_a_prior = 100.0;

/// Does the closed loop move it?
bool moved(const WorkingParameter& p) {
  return p.kind != Kind::fixed && !p.by_readings;
}

/// The base parameters, then the effects' own that the closed loop moves.
std::vector<FitParameter> unknowns_of(const Fitter& fitter, const Candidate& start) {
  std::vector<FitParameter> unknowns;
  const Vector deviations = fitter.deviations(start.axis);
  for (std::size_t i = 0; i < fitter.base().size(); ++i) {
    const auto& p = fitter.base()[i];
    const double nominal = value_of(p, fitter.nominal()), now = value_of(p, start.axis);
    const double linear = (now - nominal) / fitter.tolerance(i), believed = deviations[static_cast<Index>(i)];
    unknowns.push_back({.key = std::string(p.entry->key),
                        .nominal = nominal,
                        .lowest = p.entry->lowest,
                        .highest = p.entry->highest,
                        .scale = fitter.tolerance(i),
                        .prior = std::abs(believed) > 1.0 ? std::max(1.0, linear / believed) : 1.0,
                        .start = now});
  }
  for (const auto& effect : start.effects)
    for (std::size_t j = 0; j < effect.q.size(); ++j) {
      const auto& p = effect.hypothesis->parameters[j];
      if (!moved(p)) continue;
      const bool by_factor = p.kind == Kind::simulated;  // a logarithm
      unknowns.push_back({.key = std::string(effect.hypothesis->id) + "." + std::string(p.name),
                          .nominal = effect.q[j],
                          .lowest = p.lowest,
                          .highest = p.highest,
                          .scale = by_factor ? 1.0 : std::max(0.3 * std::abs(effect.q[j]), 10.0 * p.step),
                          .prior = by_factor ? 1.0 : hardly_a_prior,
                          .start = {}});
    }
  return unknowns;
}

Candidate at(const Fitter& fitter, const Candidate& start, const Eigen::Ref<const Eigen::VectorXd>& point) {
  Candidate candidate = start;
  Index next = 0;
  for (const auto& p : fitter.base()) set_value(p, candidate.axis, point[next++]);
  for (auto& effect : candidate.effects)
    for (std::size_t j = 0; j < effect.q.size(); ++j)
      if (moved(effect.hypothesis->parameters[j])) effect.q[j] = point[next++];
  return candidate;
}

void add_step_error(const Fitter& fitter, Polished& polished) {
  Index next = static_cast<Index>(fitter.base().size());
  for (const auto& effect : polished.model.effects)
    for (std::size_t j = 0; j < effect.q.size(); ++j)
      if (fitted(effect.hypothesis->parameters[j].kind)) {
        polished.covariance(next, next) += std::pow(step_error * effect.q[j], 2);
        ++next;
      }
}

/// Of the unknowns that a Fit has: what a polish says of them, zero where it does not move them.
Eigen::MatrixXd as_of_fit(const Eigen::MatrixXd& polished, const Fitter& fitter, const Candidate& model) {
  std::vector<Index> own(fitter.base().size());  // where a Fit has them
  std::iota(own.begin(), own.end(), Index{0});
  std::vector<Index> shared = own;  // where the polish has them
  Index at = static_cast<Index>(own.size()), next = at;
  for (const auto& effect : model.effects)
    for (const auto& p : effect.hypothesis->parameters) {
      if (fitted(p.kind) && moved(p)) own.push_back(at), shared.push_back(next);
      at += fitted(p.kind);
      next += moved(p);
    }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(at, at);
  covariance(own, own) = polished(shared, shared);
  return covariance;
}

}  // namespace

Polished polish(const ForwardModel& forward, const Fitter& fitter, const Candidate& start, const PolishSettings& settings) {
  const auto unknowns = unknowns_of(fitter, start);
  const BatchSimulator simulator = [&](const ClosedLoopRun& run, const Eigen::MatrixXd& all) {
    const auto place = static_cast<std::size_t>(&run - forward.runs().data());
    const auto simulate = [&](const Eigen::MatrixXd& points) {
      std::vector<plant::AxisParameters> axes;
      for (Index i = 0; i < points.cols(); ++i) axes.push_back(extended(at(fitter, start, points.col(i))).of(place));
      return forward.simulate(run, axes);
    };
    auto simulated = settings.known != nullptr ? settings.known->simulated(place, all, simulate) : simulate(all);
    if (settings.learned != nullptr) settings.learned->learn(place, all, simulated);
    return simulated;
  };
  OutputErrorSettings output_error;
  output_error.prior = 1.0;
  output_error.doubt_rests = false;
  output_error.encoder_grids = 0;
  output_error.largest_deviations = 3.0;
  output_error.rounds = settings.rounds;
  output_error.most_iterations = settings.most_iterations;
  output_error.coloured_from_start = settings.coloured_from_start;
  output_error.intervals = settings.intervals;
  output_error.kept_steps = 2;
  output_error.least_fall = settings.least_fall_nats;
  const auto fit = fit_output_error(forward.runs(), unknowns, simulator, output_error);
  Polished polished{at(fitter, start, fit.point()), {}, fit.cost};
  if (fit.covariance.size() == 0) return polished;
  polished.covariance = as_of_fit(fit.covariance, fitter, start);
  for (std::size_t i = 0; i < fitter.base().size(); ++i) {
    const auto place = static_cast<Index>(i);
    polished.covariance.row(place) /= fitter.tolerance(i);
    polished.covariance.col(place) /= fitter.tolerance(i);
  }
  add_step_error(fitter, polished);
  return polished;
}

}  // namespace feedtwin::tools::diagnosis
