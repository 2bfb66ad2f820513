#include "tools/diagnose/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tools/diagnose/lines.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {

Candidate without(const Candidate& model, std::size_t effect) {
  Candidate less = model;
  less.effects.erase(less.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  return less;
}

bool has(const Candidate& model, const Hypothesis& hypothesis) {
  return std::ranges::any_of(model.effects, [&hypothesis](const Active& a) { return a.hypothesis == &hypothesis; });
}

Fitter::Fitter(const InverseModel& model, const plant::AxisParameters& nominal)
    : model_(model), nominal_(nominal), base_(base_parameters(model.power_recorded())), structure_(model) {}

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

Vector Fitter::whitened(const Candidate& at, const Vector& residual, const Whitening& whitening) const {
  const auto n = static_cast<Index>(base_.size());
  Vector white(residual.size() + n);
  white.head(residual.size()) = whitening.applied(model_, residual);
  white.tail(n) = -deviations(at.axis);
  return white;
}

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

Fit Fitter::linearised(const Candidate& at, const Whitening& whitening) const {
  Fit fit;
  fit.model = at;
  fit.base = base_;
  const auto contacts = model_.contacts(at.axis, at.effects);
  fit.residual = model_.residual(at.axis, at.effects, contacts);
  fit.white = whitened(at, fit.residual, whitening);
  fit.cost = fit.white.squaredNorm();

  struct Unknown {
    std::size_t effect, parameter;
    bool base;
  };
  std::vector<Unknown> unknowns;
  for (std::size_t i = 0; i < base_.size(); ++i) unknowns.push_back({0, i, true});
  for (std::size_t e = 0; e < at.effects.size(); ++e)
    for (std::size_t j = 0; j < at.effects[e].q.size(); ++j)
      if (fitted(at.effects[e].hypothesis->parameters[j].kind)) unknowns.push_back({e, j, false});

  fit.jacobian.resize(fit.white.size(), static_cast<Index>(unknowns.size()));
  parallel_for(unknowns.size(), [&](std::size_t u) {
    Candidate near = at;
    bool refollow = false;
    double step = 0.02;
    if (unknowns[u].base) {
      const auto& p = base_[unknowns[u].parameter];
      const double value = value_of(p, at.axis), unit = tolerance(unknowns[u].parameter);
      set_value(p, near.axis, value + step * unit);
      step = (value_of(p, near.axis) - value) / unit;
      if (step == 0.0) {
        set_value(p, near.axis, value - 0.02 * unit);
        step = (value_of(p, near.axis) - value) / unit;
      }
      refollow = p.moves_friction;
    } else {
      auto& effect = near.effects[unknowns[u].effect];
      const auto& p = effect.hypothesis->parameters[unknowns[u].parameter];
      step = effect.q[unknowns[u].parameter] + p.step > p.highest ? -p.step : p.step;
      effect.q[unknowns[u].parameter] += step;
      refollow = effect.hypothesis->friction;
    }
    const Vector r =
        refollow ? model_.residual(near.axis, near.effects) : model_.residual(near.axis, near.effects, contacts);
    fit.jacobian.col(static_cast<Index>(u)) =
        step == 0.0 ? Vector::Zero(fit.white.size()) : Vector((fit.white - whitened(near, r, whitening)) / step);
  });

  Eigen::MatrixXd information = fit.jacobian.transpose() * fit.jacobian;
  const Vector diagonal = information.diagonal();
  for (Index i = 0; i < diagonal.size(); ++i) information(i, i) += 1e-12 * diagonal[i] + 1e-12;
  fit.covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(diagonal.size(), diagonal.size()));
  return fit;
}

Fit Fitter::fit(const Candidate& start, const Whitening& whitening, int iterations) const {
  constexpr int longer = 5;            // times as many iterations while it still goes down fast:
  constexpr double fast_share = 1e-3;  // steps are bounded, and from a far start a few do not arrive
  Fit best = linearised(start, whitening);
  for (int i = 0; i < longer * iterations; ++i) {
    const Eigen::MatrixXd information = best.jacobian.transpose() * best.jacobian;
    const Vector slope = best.jacobian.transpose() * best.white;
    bool better = false;
    Candidate next;
    double cost = best.cost;
    struct Try {
      double damping, length;
    };
    // shorter along the same line first, since steps are bounded; then as Levenberg and Marquardt
    for (const auto [damping, length] :
         {Try{0.0, 1.0}, {0.0, 0.5}, {0.0, 0.2}, {1e-3, 1.0}, {3e-2, 1.0}, {0.3, 1.0}, {3.0, 1.0}}) {
      Eigen::MatrixXd damped = information;
      damped.diagonal() += (damping + 1e-12) * information.diagonal() + Vector::Constant(slope.size(), 1e-12);
      next = moved(best.model, length * damped.ldlt().solve(slope));
      cost = whitened(next, model_.residual(next.axis, next.effects), whitening).squaredNorm();
      better = cost < best.cost;
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
  const Vector rest = residual - structure_.part_of(residual);
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
