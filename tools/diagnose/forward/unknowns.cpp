#include "tools/diagnose/forward/unknowns.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// In units of an effect's scale: wide, but where only a combination of its numbers tells, the others stay in sight of it.
constexpr double hardly_a_prior = 100.0;

FitParameter of_nominal(const Fitter& fitter, std::size_t i, double now, double believed) {
  const auto& p = fitter.base()[i];
  const double nominal = value_of(p, fitter.nominal()), linear = (now - nominal) / fitter.tolerance(i);
  return {.key = std::string(p.entry->key),
          .nominal = nominal,
          .lowest = p.entry->lowest,
          .highest = p.entry->highest,
          .scale = fitter.tolerance(i),
          .prior = std::abs(believed) > 1.0 ? std::max(1.0, linear / believed) : 1.0,
          .start = now};
}

FitParameter of_effect(const Active& effect, std::size_t j) {
  const auto& p = effect.hypothesis->parameters[j];
  const bool by_factor = p.kind == Kind::simulated;  // a logarithm
  return {.key = std::string(effect.hypothesis->id) + "." + std::string(p.name),
          .nominal = effect.q[j],
          .lowest = p.lowest,
          .highest = p.highest,
          .scale = by_factor ? 1.0 : std::max(0.3 * std::abs(effect.q[j]), 10.0 * p.step),
          .prior = by_factor ? 1.0 : hardly_a_prior,
          .start = {}};
}

bool moves(const WorkingParameter& p) {
  return p.kind != Kind::fixed;
}

/// Of a line, as a row each: how much more a run has of it than the first that has it, relative.
/// @param at where its first sine stands
Eigen::MatrixXd shares_of(const Active& line, Index at, Index unknowns) {
  std::vector<Eigen::VectorXd> more;
  for (std::size_t run = 0; run < line_runs; ++run) {
    if (!has_line(line.q, run)) continue;
    const auto one = line_of_run(line.q, run) / std::norm(line_of_run(line.q, run));
    more.emplace_back(Eigen::VectorXd::Zero(unknowns));
    const Index sine = at + 2 * static_cast<Index>(run);
    more.back()[sine] = one.real(), more.back()[sine + 1] = one.imag();
  }
  Eigen::MatrixXd shares(std::max<Index>(0, static_cast<Index>(more.size()) - 1), unknowns);
  for (Index i = 0; i < shares.rows(); ++i) shares.row(i) = more[static_cast<std::size_t>(i) + 1] - more[0];
  return shares;
}

/// The closed loop has one amplitude of a line for all runs, the root of their mean square: how they share it nothing tells.
/// With that as it is, F q = 0: C - C F' (F C F')^-1 F C. Otherwise it leaks into the whole's interval: 0.042 of -0.017 to
/// 0.10 m/s^2.
void hold_shares(Eigen::MatrixXd& of_fit, const std::vector<Active>& effects, Index at) {
  for (const auto& effect : effects) {
    if (effect.hypothesis->line_of != nullptr) {
      const Eigen::MatrixXd shares = shares_of(effect, at, of_fit.rows()), told = shares * of_fit;
      of_fit -= told.transpose() * inverse_of(told * shares.transpose()) * told;
    }
    at += static_cast<Index>(freedom(*effect.hypothesis));
  }
}

}  // namespace

Unknowns::Unknowns(const Fitter& fitter, const Candidate& start) : fitter_(fitter), start_(start) {}

std::vector<FitParameter> Unknowns::parameters() const {
  std::vector<FitParameter> all;
  const Vector deviations = fitter_.deviations(start_.axis);
  for (std::size_t i = 0; i < fitter_.base().size(); ++i)
    all.push_back(of_nominal(fitter_, i, value_of(fitter_.base()[i], start_.axis), deviations[static_cast<Index>(i)]));
  for (const auto& effect : start_.effects)
    for (std::size_t j = 0; j < effect.q.size(); ++j)
      if (moves(effect.hypothesis->parameters[j])) all.push_back(of_effect(effect, j));
  return all;
}

Eigen::Index Unknowns::count(std::size_t effects) const {
  auto all = static_cast<Index>(fitter_.base().size());
  for (std::size_t e = 0; e < effects; ++e) all += std::ranges::count_if(start_.effects[e].hypothesis->parameters, moves);
  return all;
}

Candidate Unknowns::at(const Eigen::Ref<const Eigen::VectorXd>& point) const {
  Candidate candidate = start_;
  Index next = 0;
  for (const auto& p : fitter_.base()) set_value(p, candidate.axis, point[next++]);
  for (auto& effect : candidate.effects)
    for (std::size_t j = 0; j < effect.q.size(); ++j)
      if (moves(effect.hypothesis->parameters[j])) effect.q[j] = point[next++];
  return candidate;
}

Eigen::MatrixXd Unknowns::as_of_fit(const Eigen::MatrixXd& covariance) const {
  std::vector<Index> here, there;   // of those that both have
  std::vector<double> unit, error;  // of each of these: of a Fit, and of the engine
  for (std::size_t i = 0; i < fitter_.base().size(); ++i) {
    here.push_back(static_cast<Index>(i)), there.push_back(static_cast<Index>(i));
    unit.push_back(fitter_.tolerance(i)), error.push_back(0.0);
  }
  Index own = static_cast<Index>(here.size()), fits = own;
  for (const auto& effect : start_.effects)
    for (std::size_t j = 0; j < effect.q.size(); ++j) {
      const auto& p = effect.hypothesis->parameters[j];
      if (fitted(p.kind) && moves(p)) {
        here.push_back(own), there.push_back(fits);
        unit.push_back(1.0), error.push_back(step_error * effect.q[j]);
      }
      own += moves(p);
      fits += fitted(p.kind);
    }
  Eigen::MatrixXd of_fit = Eigen::MatrixXd::Zero(fits, fits);
  for (std::size_t i = 0; i < here.size(); ++i)
    for (std::size_t j = 0; j < here.size(); ++j)
      of_fit(there[i], there[j]) = covariance(here[i], here[j]) / (unit[i] * unit[j]);
  hold_shares(of_fit, start_.effects, static_cast<Index>(fitter_.base().size()));
  for (std::size_t i = 0; i < here.size(); ++i) of_fit(there[i], there[i]) += error[i] * error[i];
  return of_fit;
}

}  // namespace feedtwin::tools::diagnosis
