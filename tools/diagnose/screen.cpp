#include "tools/diagnose/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <set>
#include <span>

#include "tools/diagnose/asking.h"
#include "tools/diagnose/edges.h"
#include "tools/diagnose/workpiece.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t most_by_chance = 24;  ///< grid points of a hypothesis that surrogates are tried on
constexpr double step_Hz = 0.01;            // between frequencies that are told apart
constexpr double much = 0.05;               // of the squares that it touches

/// Power of the whitened residual at a frequency, over all runs.
double line_power(const InverseModel& model, const Vector& white, double frequency_Hz) {
  double power = 0.0;
  for (const auto& s : model.segments()) {
    const auto& equation = model.equations()[s.equation];
    if (!equation.guide || s.size == 0) continue;
    const double per_row = 2.0 * std::numbers::pi * frequency_Hz * model.tracks()[s.run].row_s();
    const std::complex<double> turn = std::polar(1.0, per_row);
    std::complex<double> phase = 1.0, sum = 0.0;
    for (Index k = 0; k < s.size; ++k, phase *= turn) sum += white[s.start + k] * phase;
    power += std::norm(sum) / static_cast<double>(s.size);
  }
  return power;
}

/// Between the grid's frequencies: a phase that runs away within a run would end each cut.
double strongest_near(const InverseModel& model, const Vector& white, double frequency_Hz) {
  constexpr int steps = 10;
  std::pair<double, double> best{0.0, frequency_Hz};
  for (int i = -steps; i <= steps; ++i) {
    const double near_Hz = frequency_Hz + step_Hz * i;
    best = std::max(best, {line_power(model, white, near_Hz), near_Hz});
  }
  return best.second;
}

/// Of the strongest lines those that act in parts of the runs, as shapes of their own: frequency, ramp, the parts by run.
void add_windows(std::vector<std::vector<double>>& kept, const InverseModel& model, const Vector& white, const Fit& fit) {
  constexpr std::size_t strongest = 3;
  // a process does not stop where the speed changes: two had 0 to 0.55 in their cuts, a real screw's ripple 0.81 and more;
  // one that cuts at steady speeds does at several
  constexpr double most_at_one_speed = 0.7;
  const std::size_t lines = std::min(strongest, kept.size());
  std::set<long> seen;  // grid points beside each other climb the same line
  for (std::size_t i = 0; i < lines; ++i) {
    const double frequency_Hz = strongest_near(model, white, kept[i][0]);
    if (!seen.insert(std::lround(frequency_Hz / step_Hz)).second) continue;
    auto windows = windows_of_line(model, white, frequency_Hz);
    if (std::ranges::all_of(windows, &Windows::empty) || share_at_one_speed(model.tracks(), windows) > most_at_one_speed)
      continue;
    const Cuts cuts = sharpened(model, model.residual(fit.model.axis, fit.model.effects), frequency_Hz, std::move(windows));
    std::vector<double> shape = kept[i];
    shape[0] = frequency_Hz, shape[1] = cuts.ramp_s;
    set_windows(2, shape, cuts.windows);
    kept.push_back(std::move(shape));  // last: the others meet the same chance with it or without
  }
}

/// Of the strongest lines those that act along a part of the travel, likewise: frequency, from where to where.
void add_places(std::vector<std::vector<double>>& kept, const InverseModel& model, const Vector& lines_in) {
  constexpr double apart_Hz = 1.0;
  std::vector<std::vector<double>> added;
  std::vector<double> seen_Hz;
  for (const auto& shape : kept) {
    const auto near = [&](double seen) { return std::abs(seen - shape[0]) < apart_Hz; };
    if (std::ranges::any_of(seen_Hz, near)) continue;  // grid points beside each other climb the same line
    seen_Hz.push_back(shape[0]);
    const double frequency_Hz = strongest_near(model, lines_in, shape[0]);
    if (const auto place = place_of_line(model, lines_in, frequency_Hz))
      added.push_back({frequency_Hz, place->from_m, place->to_m, place->only_direction});
  }
  kept.insert(kept.end(), added.begin(), added.end());
}

/// The shapes that are worth asking about: of frequencies the strongest lines, some others for what chance does.
std::vector<std::vector<double>> grid_of(const Hypothesis& hypothesis, const InverseModel& model, const Vector& white,
                                         const Fit& fit) {
  auto grid = hypothesis.shapes_for != nullptr ? hypothesis.shapes_for(model.tracks()) : hypothesis.shapes;
  if (hypothesis.where != Where::frequency) return grid;
  constexpr std::size_t strongest = 12, spread = 12;
  const Vector lines_in = hypothesis.turns ? turned(model, white) : white;
  std::erase_if(grid, [&](const auto& shape) { return shape[0] > model.tracks().front().highest_line_Hz() + 1e-9; });
  std::vector<std::pair<double, std::size_t>> lines;
  for (std::size_t i = 0; i < grid.size(); ++i) lines.emplace_back(line_power(model, lines_in, grid[i][0]), i);
  std::ranges::sort(lines, std::greater{});
  std::vector<std::vector<double>> kept;
  for (std::size_t i = 0; i < std::min(strongest, lines.size()); ++i) kept.push_back(grid[lines[i].second]);
  if (hypothesis.turns) add_places(kept, model, lines_in);
  for (std::size_t i = 0; i < grid.size(); i += 1 + grid.size() / spread) kept.push_back(grid[i]);
  if (hypothesis.first_window > 0) add_windows(kept, model, white, fit);
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

bool Screen::leaves_to(const Score& before) const {
  constexpr double nearly = 0.8;
  const auto now = std::ranges::find(scores, before.hypothesis, &Score::hypothesis);
  return now != scores.end() && now->gain > nearly * before.gain;
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
  constexpr int first_look = 2, most_rounds = 4;
  constexpr double clearly = 10.0;  // of the cost
  Candidate start = model;
  start.effects.insert(start.effects.begin() + static_cast<std::ptrdiff_t>(place), at_zero(more));
  Fit best = fitter.fit(start, whitening, iterations);
  const auto allowed = [place](const Fit& fit) { return possible(fit.model.effects[place], fit.model.axis); };
  auto starts = more.hypothesis->starts;
  if (more.hypothesis->jumps || more.hypothesis->reaches.size() > 1) starts.push_back(more.q);
  const auto try_from = [&](const std::vector<double>& q) {
    if (q == at_zero(more).q) return false;
    start.effects[place].q = q;
    const Fit other = fitter.fit(start, whitening, first_look);
    const bool better = allowed(other) == allowed(best) ? other.cost < best.cost - clearly : allowed(other);
    if (better) best = fitter.fit(other.model, whitening, iterations);
    return better;
  };
  for (const auto& q : starts) try_from(q);
  bool better = more.hypothesis->starts_after != nullptr;
  for (int round = 0; better && round < most_rounds; ++round) {
    better = false;
    for (const auto& q : more.hypothesis->starts_after(best.model.effects[place].q)) better |= try_from(q);
  }
  return best;
}

namespace {

std::vector<Task> tasks_of(const std::vector<const Hypothesis*>& asked, bool against_chance, const Fit& fit,
                           const std::vector<std::vector<std::vector<double>>>& grids) {
  std::vector<Task> tasks;
  for (std::size_t h = 0; h < asked.size(); ++h) {
    const auto& shapes = grids[h];
    if (has(fit.model, *asked[h])) continue;
    const std::size_t every = 1 + shapes.size() / most_by_chance;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (const double reach : asked[h]->reaches)
        tasks.push_back({asked[h], &shapes[i], reach, against_chance && i % every == 0});
  }
  return tasks;
}

/// The best two that come near the best of a hypothesis whose shape stays as it starts.
std::vector<std::vector<double>> nearly_as_good(std::span<const Score> scores, const Score& best) {
  constexpr double nearly = 0.7;
  constexpr std::size_t most = 2;
  const auto& parameters = best.hypothesis->parameters;
  const auto another = [&](const Score& score) {
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i].kind == Kind::fixed && score.q[i] != best.q[i]) return true;
    return false;
  };
  std::vector<const Score*> others;
  for (const auto& score : scores)
    if (score.gain > nearly * best.gain && another(score)) others.push_back(&score);
  std::ranges::sort(others, std::greater{}, &Score::gain);
  std::vector<std::vector<double>> also;
  for (std::size_t i = 0; i < std::min(most, others.size()); ++i) also.push_back(others[i]->q);
  return also;
}

Screen screen(const std::vector<const Hypothesis*>& asked, bool against_chance, const Fitter& fitter, const Fit& fit,
              const Whitening& whitening) {
  const Asking asking(fitter, fit, whitening);
  std::vector<std::vector<std::vector<double>>> grids;
  for (const auto* hypothesis : asked) grids.push_back(grid_of(*hypothesis, fitter.model(), asking.left(), fit));
  const auto tasks = tasks_of(asked, against_chance, fit, grids);
  std::vector<Score> found(tasks.size());
  Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(static_cast<Index>(tasks.size()), surrogates);
  parallel_for(tasks.size(), [&](std::size_t t) {
    const Columns columns = asking.columns_of(tasks[t]);
    found[t] = asking.score_of(tasks[t], columns);
    // without what it explains, should it be real
    if (tasks[t].by_chance && columns.any)
      gains.row(static_cast<Index>(t)) = asking.by_chance(columns, asking.without(columns));
  });

  Screen result;
  Eigen::VectorXd largest = Eigen::VectorXd::Constant(surrogates, -1e300);
  for (std::size_t t = 0; t < tasks.size();) {
    std::size_t end = t, best_task = t;
    while (end < tasks.size() && tasks[end].hypothesis == tasks[t].hypothesis) {
      if (found[end].gain > found[best_task].gain) best_task = end;
      ++end;
    }
    Score score = found[best_task];
    score.also = nearly_as_good(std::span(found).subspan(t, end - t), score);
    // Where it explains much, another of its shapes sees that as noise of its own kind, and within a block the two are
    // nearly one: a ripple of order 12 is nearly one of 11.75. So it comes off for all of them.
    if (against_chance && score.gain > much * score.touched) {
      const Vector rest = asking.without(asking.columns_of(tasks[best_task]));
      parallel_for(end - t, [&](std::size_t i) {
        if (tasks[t + i].by_chance)
          gains.row(static_cast<Index>(t + i)) = asking.by_chance(asking.columns_of(tasks[t + i]), rest);
      });
    }
    const Eigen::VectorXd best =
        gains.middleRows(static_cast<Index>(t), static_cast<Index>(end - t)).colwise().maxCoeff().transpose().cwiseMax(0.0);
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
