#include "tools/diagnose/fit.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/lines.h"
#include "tools/diagnose/neighbours.h"
#include "tools/large_blocks.h"
#include "tools/linear_systems.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {

Candidate without(const Candidate& model, std::size_t effect) {
  Candidate less = model;
  less.effects.erase(less.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  return less;
}

bool names_no_force(const Candidate& model) {
  return std::ranges::none_of(model.effects, [&](const Active& active) {
    return worth_naming(active, model.axis) && rests_on_force(*active.hypothesis);
  });
}

bool has(const Candidate& model, const Hypothesis& hypothesis) {
  return std::ranges::any_of(model.effects, [&hypothesis](const Active& a) { return a.hypothesis == &hypothesis; });
}

Fitter::Fitter(const InverseModel& model, const plant::AxisParameters& nominal)
    : model_(model),
      nominal_(nominal),
      base_(base_parameters(model.power_recorded())),
      structure_(model),
      power_structure_(model) {}

double Fitter::tolerance(std::size_t parameter) const {
  const auto& p = base_[parameter];
  const double value = std::abs(value_of(p, nominal_));
  if (value > 0.0) return p.tolerance * value;
  const double span = std::min(p.entry->highest, 1e3) - std::max(p.entry->lowest, -1e3);
  return 1e-4 * span;
}

Vector Fitter::deviations(const plant::AxisParameters& axis) const {
  Vector out(static_cast<Index>(base_.size()));
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const double now = value_of(base_[i], axis), nominal = value_of(base_[i], nominal_);
    const bool by_factor = base_[i].known_to_a_factor && now > 0.0 && nominal > 0.0;
    out[static_cast<Index>(i)] = by_factor ? std::log(now / nominal) / base_[i].tolerance : (now - nominal) / tolerance(i);
  }
  return out;
}

Vector Fitter::from_prior(const Candidate& at) const {
  Vector all = deviations(at.axis);
  for (const auto& effect : at.effects) {
    if (effect.hypothesis->unlikely == nullptr) continue;
    all.conservativeResize(all.size() + 1);
    all[all.size() - 1] = effect.hypothesis->unlikely(effect.q, at.axis);
  }
  return all;
}

Vector Fitter::whitened(const Candidate& at, const Vector& residual, const Whitening& whitening) const {
  const Vector prior = from_prior(at);
  Vector white(residual.size() + prior.size());
  white.head(residual.size()) = whitening.applied(model_, residual);
  white.tail(prior.size()) = -prior;
  return white;
}

std::vector<Index> Fitter::without_true_slope(const Fit& fit) const {
  constexpr double nothing = 1e-3;  // of the prior's own slope
  std::vector<Index> found;
  for (Index i = 0; i < fit.base_count(); ++i)
    if (fit.jacobian.col(i).head(model_.rows()).norm() < nothing) found.push_back(i);
  Index unknown = fit.base_count();
  for (const auto& effect : fit.model.effects)
    for (const auto& p : effect.hypothesis->parameters) {
      if (!fitted(p.kind)) continue;
      if (effect.hypothesis->jumps) found.push_back(unknown);
      ++unknown;
    }
  return found;
}

namespace {

/// @param held unknowns that stay where they are
Vector damped_step(const Fit& at, Vector slope, double damping, const std::vector<Index>& held) {
  Eigen::MatrixXd damped = at.information;
  damped.diagonal() += (damping + 1e-12) * at.information.diagonal() + Vector::Constant(slope.size(), 1e-12);
  for (const Index unknown : held) {
    damped.row(unknown).setZero();
    damped.col(unknown).setZero();
    damped(unknown, unknown) = 1.0;
    slope[unknown] = 0.0;
  }
  return solved(damped, slope);
}

}  // namespace

Candidate Fitter::moved(const Candidate& from, const Vector& step) const {
  Candidate to = from;
  Index at = 0;
  for (std::size_t i = 0; i < base_.size(); ++i, ++at) {
    const double value = value_of(base_[i], from.axis);
    const double change = step[at] * tolerance(i);
    // by its nominal size too: a number that a wrong model took to nothing must find its way back
    const double size = std::max(std::abs(value), std::abs(value_of(base_[i], nominal_)));
    const double most = 0.4 * std::max(size, tolerance(i));
    set_value(base_[i], to.axis, value + std::clamp(change, -most, most));
  }
  for (auto& effect : to.effects)
    for (std::size_t j = 0; j < effect.q.size(); ++j) {
      const auto& p = effect.hypothesis->parameters[j];
      if (!fitted(p.kind)) continue;
      double change = step[at++];
      if (p.kind == Kind::shape) {
        const double most = std::max(20.0 * p.step, 0.25 * std::abs(effect.q[j]));
        change = std::clamp(change, -most, most);
      }
      effect.q[j] = std::clamp(effect.q[j] + change, p.lowest, p.highest);
    }
  return to;
}

std::vector<Fitter::Beside> Fitter::beside_of(const Candidate& at) const {
  constexpr double share_of_tolerance = 0.02;
  std::vector<Beside> all;
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const auto& p = base_[i];
    const double value = value_of(p, at.axis), unit = tolerance(i);
    Beside near{at, 0.0, p.moves_friction};
    for (const double share : {share_of_tolerance, -share_of_tolerance}) {  // back where a bound is in the way
      set_value(p, near.model.axis, value + share * unit);
      near.step = (value_of(p, near.model.axis) - value) / unit;
      if (near.step != 0.0) break;
    }
    all.push_back(std::move(near));
  }
  for (std::size_t e = 0; e < at.effects.size(); ++e)
    for (std::size_t j = 0; j < at.effects[e].q.size(); ++j) {
      const auto& p = at.effects[e].hypothesis->parameters[j];
      if (!fitted(p.kind)) continue;
      Beside near{at, p.step, moves_friction(*at.effects[e].hypothesis, at.effects)};
      double& value = near.model.effects[e].q[j];
      if (value + near.step > p.highest) near.step = -near.step;
      value += near.step;
      all.push_back(std::move(near));
    }
  return all;
}

Fit Fitter::linearised(const Candidate& at, const Whitening& whitening) const {
  const std::vector<Beside> beside = beside_of(at);
  std::vector<InverseModel::Asked> refollowed{{&at.axis, &at.effects}};
  for (const auto& one : beside)
    if (one.refollow) refollowed.push_back({&one.model.axis, &one.model.effects});
  const auto contacts = model_.contacts(refollowed);

  const Neighbours neighbours(model_, at.axis, at.effects, contacts.front());
  Fit fit;
  fit.model = at;
  fit.base = base_;
  fit.residual = neighbours.residual();
  fit.white = whitened(at, fit.residual, whitening);
  fit.cost = fit.white.squaredNorm();
  std::vector<const std::vector<ContactForces>*> own;
  auto next = contacts.begin() + 1;
  for (const auto& one : beside) own.push_back(one.refollow ? &*next++ : &contacts.front());
  const Vector prior = from_prior(at);
  fit.jacobian.resize(fit.white.size(), static_cast<Index>(beside.size()));
  ask_for_large_pages(fit.jacobian);
  parallel_for(beside.size(), [&](std::size_t u) {
    const auto& [near, step, refollow] = beside[u];
    auto column = fit.jacobian.col(static_cast<Index>(u));
    if (step == 0.0) {
      column.setZero();
      return;
    }
    column.head(model_.rows()) = neighbours.fall(near.axis, near.effects, *own[u]) / step;
    column.tail(prior.size()) = (from_prior(near) - prior) / step;
    whitening.apply(model_, column.head(model_.rows()));
  });

  fit.information = gram(fit.jacobian);
  Eigen::MatrixXd known = fit.information;
  known.diagonal() += 1e-12 * known.diagonal() + Vector::Constant(fit.jacobian.cols(), 1e-12);
  fit.covariance = inverse_of(known);
  return fit;
}

Fit Fitter::fit(const Candidate& start, const Whitening& whitening, int iterations) const {
  constexpr int longer = 5;            // times as many iterations while it still goes down fast:
  constexpr double fast_share = 1e-3;  // steps are bounded, and from a far start a few do not arrive
  Fit best = linearised(start, whitening);
  for (int i = 0; i < longer * iterations; ++i) {
    const Vector slope = transposed_times(best.jacobian, best.white);
    const std::vector<Index> untrue = without_true_slope(best);
    bool better = false;
    Candidate next;
    double cost = best.cost;
    struct Try {
      double damping, length;
      bool held;
    };
    // shorter along the same line first, since steps are bounded; then as Levenberg and Marquardt; at last
    // without those whose slopes promise what no step keeps, if that brings more than a crumb
    for (const auto [damping, length, held] : {Try{0.0, 1.0, false},
                                               {0.0, 0.5, false},
                                               {0.0, 0.2, false},
                                               {1e-3, 1.0, false},
                                               {3e-2, 1.0, false},
                                               {0.3, 1.0, false},
                                               {3.0, 1.0, false},
                                               {0.0, 1.0, true},
                                               {0.0, 0.3, true}}) {
      if (held && untrue.empty()) break;
      next = moved(best.model, length * damped_step(best, slope, damping, held ? untrue : std::vector<Index>{}));
      cost = whitened(next, model_.residual(next.axis, next.effects), whitening).squaredNorm();
      better = cost < (held ? 1.0 - fast_share : 1.0) * best.cost;
      if (better) break;
    }
    if (!better) break;
    const double gain = best.cost - cost;
    best = linearised(next, whitening);
    if (gain < (i + 1 < iterations ? 1e-5 : fast_share) * best.cost) break;
  }
  return best;
}

Whitening Fitter::colour_of(const Vector& residual) const {
  const Vector rest = residual - structure_.part_of(residual) - power_structure_.part_of(residual);
  return Whitening::estimate(model_, rest - sharp_lines(model_, rest));
}

Fit Fitter::fit_with_colour(const Candidate& start, Whitening& whitening, int rounds, int iterations) const {
  Fit best;
  Candidate at = start;
  for (int round = 0; round < rounds; ++round) {
    best = fit(at, whitening, iterations);
    at = best.model;
    whitening = colour_of(best.residual);
  }
  return linearised(at, whitening);
}

}  // namespace feedtwin::tools::diagnosis
