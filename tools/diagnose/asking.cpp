#include "tools/diagnose/asking.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index block_rows = 50;  // 0.2 s: longer than a reversal's burst

/// Stretches of rows whose sign a surrogate draws at random: their strength stays, their relation to any regressor goes.
std::vector<Segment> blocks_of(const InverseModel& model) {
  std::vector<Segment> blocks;
  for (const auto& segment : model.segments()) {
    const Index block = model.equations()[segment.equation].power ? 1 : block_rows;
    for (Index k = 0; k < segment.size; k += block)
      blocks.push_back({segment.equation, segment.run, segment.start + k, std::min(block, segment.size - k)});
  }
  return blocks;
}

Eigen::MatrixXd random_signs(std::size_t blocks) {
  std::mt19937 random(20140501);  // NOLINT(bugprone-random-generator-seed): the same answer for the same input
  Eigen::MatrixXd signs(static_cast<Index>(blocks), surrogates);
  for (Index s = 0; s < surrogates; ++s)
    for (Index b = 0; b < signs.rows(); ++b) signs(b, s) = (random() & 1U) != 0U ? 1.0 : -1.0;
  return signs;
}

std::vector<double> with_shape(const Hypothesis& hypothesis, const std::vector<double>& shape) {
  std::vector<double> q(hypothesis.parameters.size(), 0.0);
  std::size_t next = 0;
  for (std::size_t i = 0; i < q.size(); ++i)
    if (hypothesis.parameters[i].kind != Kind::amplitude) q[i] = shape[next++];
  return q;
}

std::vector<std::size_t> amplitudes_of(const Hypothesis& hypothesis) {
  std::vector<std::size_t> amplitudes;
  for (std::size_t i = 0; i < hypothesis.parameters.size(); ++i)
    if (hypothesis.parameters[i].kind == Kind::amplitude) amplitudes.push_back(i);
  return amplitudes;
}

}  // namespace

Asking::Asking(const Fitter& fitter, const Fit& fit, const Whitening& whitening)
    : model_(fitter.model()),
      fit_(fit),
      whitening_(whitening),
      q_(orthonormal(fit.jacobian)),
      left_(fit.white - q_ * (q_.transpose() * fit.white)),
      standing_(model_.standing(
          fit.model.axis,
          model_.prepared(fit.model.axis, fit.model.effects, model_.contacts(fit.model.axis, fit.model.effects)),
          fit.residual)),
      blocks_(blocks_of(model_)),
      signs_(random_signs(blocks_.size())) {}

Vector Asking::fall_of(const Active& more) const {
  if (!more.hypothesis->friction) return model_.fall(standing_, more);
  auto effects = fit_.model.effects;
  effects.push_back(more);
  return fit_.residual - model_.residual(fit_.model.axis, effects);
}

Columns Asking::columns_of(const Task& task) const {
  const Hypothesis& hypothesis = *task.hypothesis;
  const std::vector<double> at = with_shape(hypothesis, *task.shape);
  const auto amplitudes = amplitudes_of(hypothesis);
  const auto count = static_cast<Index>(amplitudes.size());
  Columns c;
  c.white.resize(model_.rows(), count);
  for (std::size_t a = 0; a < amplitudes.size(); ++a) {
    Active near{&hypothesis, at};
    const double step = task.reach * hypothesis.parameters[amplitudes[a]].step;
    near.q[amplitudes[a]] = step;
    c.white.col(static_cast<Index>(a)) = fall_of(near) / step;
  }
  whitening_.apply(model_, c.white);
  // only the rows of the equations that it touches count; what the model's own numbers can do comes off
  c.on_q = Eigen::MatrixXd::Zero(q_.cols(), count);
  for (const auto& s : model_.segments()) {
    bool any = false;
    for (Index k = 0; k < count; ++k) {
      const auto part = c.white.col(k).segment(s.start, s.size);
      if (s.size == 0 || !(part.cwiseAbs().maxCoeff() > 0.0)) continue;  // a line's amplitude is of one run
      c.on_q.col(k).noalias() += q_.middleRows(s.start, s.size).transpose() * part;
      any = true;
    }
    if (any) c.touched += left_.segment(s.start, s.size).squaredNorm();
  }
  const Vector before = c.white.colwise().squaredNorm();
  c.any = before.maxCoeff() > 0.0;
  if (!c.any) return c;
  c.gram = c.white.transpose() * c.white - c.on_q.transpose() * c.on_q;
  // where only the numbers' tolerance stands against it a ten-millionth may be left; less is rounding of the projection
  for (Index k = 0; k < count; ++k) {
    if (!(c.gram(k, k) > 1e-11 * before[k])) c.gram(k, k) += 1e6 * (before[k] + 1e-30);  // nothing the model could not do
    if (before[k] < 1e-20 * before.maxCoeff()) c.gram(k, k) += before.maxCoeff();  // of a run that is not there: rounding
  }
  c.solver.compute(c.gram);
  c.amplitude = c.solver.solve(c.white.transpose() * left_.head(model_.rows()));
  return c;
}

Score Asking::score_of(const Task& task, const Columns& c) const {
  const Hypothesis& hypothesis = *task.hypothesis;
  Score score{&hypothesis, with_shape(hypothesis, *task.shape), c.touched, 0.0, 0.0, {}};
  if (!c.any) return score;
  score.gain = c.amplitude.dot(c.white.transpose() * left_.head(model_.rows()));
  // the wrong sign, or beyond what can be: what the nearest possible value brings
  Vector reachable = c.amplitude;
  const auto amplitudes = amplitudes_of(hypothesis);
  for (std::size_t a = 0; a < amplitudes.size(); ++a) {
    double& value = reachable[static_cast<Index>(a)];
    const auto& p = hypothesis.parameters[amplitudes[a]];
    value = std::clamp(value, p.lowest, p.highest);
    score.q[amplitudes[a]] = value;
  }
  const Vector off = reachable - c.amplitude;
  score.gain = std::max(0.0, score.gain - off.dot(c.gram * off));
  if (!possible({&hypothesis, score.q}, fit_.model.axis)) score.gain = 0.0;
  return score;
}

Vector Asking::without(const Columns& c) const {
  return left_.head(model_.rows()) - c.white * c.amplitude + q_.topRows(model_.rows()) * (c.on_q * c.amplitude);
}

Eigen::RowVectorXd Asking::by_chance(const Columns& c, const Vector& residual) const {
  if (!c.any) return Eigen::RowVectorXd::Zero(surrogates);
  Eigen::MatrixXd by_block(c.white.cols(), static_cast<Index>(blocks_.size()));
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto& s = blocks_[b];
    const auto rest = residual.segment(s.start, s.size);
    by_block.col(static_cast<Index>(b)) = c.white.middleRows(s.start, s.size).transpose() * rest -
                                          c.on_q.transpose() * (q_.middleRows(s.start, s.size).transpose() * rest);
  }
  const Eigen::MatrixXd drawn = by_block * signs_;
  return drawn.cwiseProduct(c.solver.solve(drawn)).colwise().sum();
}

}  // namespace feedtwin::tools::diagnosis
