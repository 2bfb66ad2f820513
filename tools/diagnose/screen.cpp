#include "tools/diagnose/screen.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>

#include "tools/linear_systems.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index surrogates = 199;
constexpr std::size_t most_by_chance = 24;  ///< grid points of a hypothesis that surrogates are tried on
constexpr Index block_rows = 50;            // 0.2 s: longer than a reversal's burst

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

struct Task {
  const Hypothesis* hypothesis;
  const std::vector<double>* shape;
  double reach;    ///< of the step that its columns are taken over
  bool by_chance;  ///< its gains on surrogates are asked for too
};

std::vector<double> with_shape(const Hypothesis& hypothesis, const std::vector<double>& shape) {
  std::vector<double> q(hypothesis.parameters.size(), 0.0);
  std::size_t next = 0;
  for (std::size_t i = 0; i < q.size(); ++i)
    if (hypothesis.parameters[i].kind != Kind::amplitude) q[i] = shape[next++];
  return q;
}

/// Power of the whitened residual at a frequency, over all runs.
double line_power(const InverseModel& model, const Vector& white, double frequency_Hz) {
  double power = 0.0;
  for (const auto& s : model.segments()) {
    const auto& equation = model.equations()[s.equation];
    if (!equation.guide || s.size == 0) continue;
    const double per_row = 2.0 * std::numbers::pi * frequency_Hz * InverseModel::decimation * model.tracks()[s.run].sample_s;
    const std::complex<double> turn = std::polar(1.0, per_row);
    std::complex<double> phase = 1.0, sum = 0.0;
    for (Index k = 0; k < s.size; ++k, phase *= turn) sum += white[s.start + k] * phase;
    power += std::norm(sum) / static_cast<double>(s.size);
  }
  return power;
}

/// The shapes that are worth asking about: of frequencies the strongest lines, some others for what chance does.
std::vector<std::vector<double>> grid_of(const Hypothesis& hypothesis, const InverseModel& model, const Vector& white) {
  auto grid = hypothesis.shapes_for != nullptr ? hypothesis.shapes_for(model.tracks()) : hypothesis.shapes;
  if (hypothesis.where != Where::frequency) return grid;
  constexpr std::size_t strongest = 12, spread = 12;
  std::vector<std::pair<double, std::size_t>> lines;
  for (std::size_t i = 0; i < grid.size(); ++i) lines.emplace_back(line_power(model, white, grid[i][0]), i);
  std::ranges::sort(lines, std::greater{});
  std::vector<std::vector<double>> kept;
  for (std::size_t i = 0; i < std::min(strongest, lines.size()); ++i) kept.push_back(grid[lines[i].second]);
  for (std::size_t i = 0; i < grid.size(); i += 1 + grid.size() / spread) kept.push_back(grid[i]);
  return kept;
}

}  // namespace

double Screen::p_false_alarm(double standard) const {
  const auto above = static_cast<double>(chance.end() - std::lower_bound(chance.begin(), chance.end(), standard));
  if (above > 0.0) return (1.0 + above) / (1.0 + static_cast<double>(chance.size()));
  // beyond all surrogates: the tail of the extreme value distribution with their mean and variance
  double mean = 0.0, square = 0.0;
  for (double value : chance) mean += value / static_cast<double>(chance.size());
  for (double value : chance) square += (value - mean) * (value - mean) / static_cast<double>(chance.size());
  const double scale = std::sqrt(6.0 * square) / std::numbers::pi + 1e-12;
  const double y = (standard - (mean - 0.5772156649 * scale)) / scale;
  return std::min(1.0 / (1.0 + static_cast<double>(chance.size())), 1.0 - std::exp(-std::exp(-y)));
}

std::string in_words(const Screen& screened) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(6, screened.scores.size()); ++i) {
    const auto& score = screened.scores[i];
    text += fmt::format("{}{} would explain {:.1f} % (gain {:.0f}, p {:.1g})", i > 0 ? ", " : "", score.hypothesis->id,
                        100.0 * score.gain / std::max(1.0, score.touched), score.gain,
                        std::max(1e-9, screened.p_false_alarm(score.standard)));
  }
  return text;
}

Active at_zero(const Score& score) {
  Active active{score.hypothesis, score.q};
  for (std::size_t i = 0; i < active.q.size(); ++i)
    if (score.hypothesis->parameters[i].kind == Kind::amplitude) active.q[i] = 0.0;
  return active;
}

Fit fit_with(const Fitter& fitter, const Candidate& model, const Score& more, std::size_t place, const Whitening& whitening,
             int iterations) {
  constexpr int first_look = 2;
  constexpr double clearly = 10.0;  // of the cost
  Candidate start = model;
  start.effects.insert(start.effects.begin() + static_cast<std::ptrdiff_t>(place), at_zero(more));
  Fit best = fitter.fit(start, whitening, iterations);
  const auto allowed = [place](const Fit& fit) { return possible(fit.model.effects[place], fit.model.axis); };
  auto starts = more.hypothesis->starts;
  if (more.hypothesis->jumps || more.hypothesis->reaches.size() > 1) starts.push_back(more.q);
  for (const auto& q : starts) {
    if (q == at_zero(more).q) continue;
    start.effects[place].q = q;
    const Fit other = fitter.fit(start, whitening, first_look);
    const bool better = allowed(other) == allowed(best) ? other.cost < best.cost - clearly : allowed(other);
    if (better) best = fitter.fit(other.model, whitening, iterations);
  }
  return best;
}

namespace {

Screen screen(const std::vector<const Hypothesis*>& asked, bool against_chance, const Fitter& fitter, const Fit& fit,
              const Whitening& whitening) {
  const InverseModel& model = fitter.model();
  const Eigen::MatrixXd q = orthonormal(fit.jacobian);
  const Vector left = fit.white - q * (q.transpose() * fit.white);
  const auto blocks = blocks_of(model);
  const Eigen::MatrixXd signs = random_signs(blocks.size());

  const auto contacts = model.contacts(fit.model.axis, fit.model.effects);
  const auto prepared = model.prepared(fit.model.axis, fit.model.effects, contacts);
  const auto fall_of = [&](const Active& more) -> Vector {
    if (!more.hypothesis->friction) return model.fall(fit.model.axis, prepared, fit.residual, more);
    auto effects = fit.model.effects;
    effects.push_back(more);
    return fit.residual - model.residual(fit.model.axis, effects);
  };
  std::vector<Task> tasks;
  std::vector<std::vector<std::vector<double>>> grids;
  for (const auto* hypothesis : asked) grids.push_back(grid_of(*hypothesis, model, left));
  for (std::size_t h = 0; h < asked.size(); ++h) {
    const auto& shapes = grids[h];
    if (has(fit.model, *asked[h])) continue;
    const std::size_t every = 1 + shapes.size() / most_by_chance;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (const double reach : asked[h]->reaches)
        tasks.push_back({asked[h], &shapes[i], reach, against_chance && i % every == 0});
  }
  std::vector<Score> found(tasks.size());
  Eigen::MatrixXd gains(static_cast<Index>(tasks.size()), surrogates);
  parallel_for(tasks.size(), [&](std::size_t t) {
    const Hypothesis& hypothesis = *tasks[t].hypothesis;
    std::vector<double> at = with_shape(hypothesis, *tasks[t].shape);
    std::vector<std::size_t> amplitudes;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (hypothesis.parameters[i].kind == Kind::amplitude) amplitudes.push_back(i);
    const auto count = static_cast<Index>(amplitudes.size());
    Eigen::MatrixXd columns(model.rows(), count);
    for (std::size_t a = 0; a < amplitudes.size(); ++a) {
      Active near{&hypothesis, at};
      const double step = tasks[t].reach * hypothesis.parameters[amplitudes[a]].step;
      near.q[amplitudes[a]] = step;
      columns.col(static_cast<Index>(a)) = fall_of(near) / step;
    }
    whitening.apply(model, columns);
    // only the rows of the equations that it touches count; what the model's own numbers can do comes off
    std::vector<bool> in(model.segments().size());
    double touched = 0.0;
    Eigen::MatrixXd on_q = Eigen::MatrixXd::Zero(q.cols(), count);
    for (std::size_t i = 0; i < in.size(); ++i) {
      const auto& s = model.segments()[i];
      in[i] = s.size > 0 && columns.middleRows(s.start, s.size).cwiseAbs().maxCoeff() > 0.0;
      if (!in[i]) continue;
      touched += left.segment(s.start, s.size).squaredNorm();
      on_q.noalias() += q.middleRows(s.start, s.size).transpose() * columns.middleRows(s.start, s.size);
    }
    found[t] = {&hypothesis, at, touched, 0.0, 0.0};
    gains.row(static_cast<Index>(t)).setZero();
    const Vector before = columns.colwise().squaredNorm();
    if (!(before.maxCoeff() > 0.0)) return;
    Eigen::MatrixXd gram = columns.transpose() * columns - on_q.transpose() * on_q;
    // where only the numbers' tolerance stands against it a ten-millionth may be left; less is rounding of the projection
    for (Index c = 0; c < count; ++c)
      if (!(gram(c, c) > 1e-11 * before[c])) gram(c, c) += 1e6 * (before[c] + 1e-30);  // nothing the model could not do
    const Eigen::LDLT<Eigen::MatrixXd> solver(gram);
    const Vector amplitude = solver.solve(columns.transpose() * left.head(model.rows()));
    found[t].gain = amplitude.dot(columns.transpose() * left.head(model.rows()));
    if (tasks[t].by_chance) {
      const Vector cut = on_q * amplitude;
      Eigen::MatrixXd by_block(count, static_cast<Index>(blocks.size()));
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        const auto& s = blocks[b];
        const auto part = columns.middleRows(s.start, s.size);
        const auto own = q.middleRows(s.start, s.size);
        // without what it explains, should it be real
        const Vector rest = left.segment(s.start, s.size) - part * amplitude + own * cut;
        by_block.col(static_cast<Index>(b)) = part.transpose() * rest - on_q.transpose() * (own.transpose() * rest);
      }
      const Eigen::MatrixXd drawn = by_block * signs;
      gains.row(static_cast<Index>(t)) = drawn.cwiseProduct(solver.solve(drawn)).colwise().sum();
    }
    // the wrong sign, or beyond what can be: what the nearest possible value brings
    Vector reachable = amplitude;
    for (std::size_t a = 0; a < amplitudes.size(); ++a) {
      double& value = reachable[static_cast<Index>(a)];
      const auto& p = hypothesis.parameters[amplitudes[a]];
      value = std::clamp(value, p.lowest, p.highest);
      found[t].q[amplitudes[a]] = value;
    }
    const Vector off = reachable - amplitude;
    found[t].gain = std::max(0.0, found[t].gain - off.dot(gram * off));
    if (!possible({&hypothesis, found[t].q}, fit.model.axis)) found[t].gain = 0.0;
  });

  Screen result;
  Eigen::VectorXd largest = Eigen::VectorXd::Constant(surrogates, -1e300);
  for (std::size_t t = 0; t < tasks.size();) {
    std::size_t end = t;
    Eigen::VectorXd best = Eigen::VectorXd::Zero(surrogates);
    Score score = found[t];
    for (; end < tasks.size() && tasks[end].hypothesis == tasks[t].hypothesis; ++end) {
      best = best.cwiseMax(gains.row(static_cast<Index>(end)).transpose());
      if (found[end].gain > score.gain) score = found[end];
    }
    const double mean = best.mean();
    const double spread = std::sqrt((best.array() - mean).square().mean()) + 1e-9;
    score.standard = (score.gain - mean) / spread;
    largest = largest.cwiseMax(((best.array() - mean) / spread).matrix());
    result.scores.push_back(score);
    t = end;
  }
  std::ranges::sort(result.scores, [](const Score& a, const Score& b) { return a.gain > b.gain; });
  result.chance.assign(largest.data(), largest.data() + largest.size());
  std::ranges::sort(result.chance);
  return result;
}

}  // namespace

Screen screen(const Fitter& fitter, const Fit& fit, const Whitening& whitening) {
  std::vector<const Hypothesis*> all;
  for (const auto& hypothesis : hypotheses()) all.push_back(&hypothesis);
  return screen(all, true, fitter, fit, whitening);
}

std::vector<Score> scores_of(const std::vector<const Hypothesis*>& only, const Fitter& fitter, const Fit& fit,
                             const Whitening& whitening) {
  return screen(only, false, fitter, fit, whitening).scores;
}

}  // namespace feedtwin::tools::diagnosis
