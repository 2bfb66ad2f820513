#include "tools/diagnose/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr int rounds = 3, iterations = 6;
constexpr std::size_t refitted = 3;

double prior_part(const Fit& fit) {
  return fit.white.tail(fit.base_count()).squaredNorm();
}

bool possible(const Active& active, const plant::AxisParameters& axis) {
  return active.hypothesis->admissible == nullptr || active.hypothesis->admissible(active.q, axis);
}

struct Step {
  Fit fit;
  double gain = -1.0, surprise = 0.0, p = 1.0, touched = 0.0;
};

/// The best of the hypotheses that pass the bar, refitted jointly.
Step best_step(const Fitter& fitter, const Fit& now, const Whitening& whitening, const Screen& screened, const Bar& bar) {
  Step best;
  const double left_N = std::max(1e-9, whitening.residual_rms(0));
  std::size_t tried = 0;
  for (const auto& score : screened.scores) {
    const double p = screened.p_false_alarm(score.standard);
    const bool force = score.hypothesis->channel != "power_W" && score.hypothesis->channel != "scale_position_m";
    const double smallness = force ? std::pow(std::max(1.0, bar.smallest_residual_N / left_N), 2) : 1.0;
    // a gain scales everything: the nominal numbers alone can't tell it
    const double enough_surprise = score.hypothesis->id == "torque_gain_error" ? 1e300 : bar.nominal_surprise;
    const double needed = (score.hypothesis->id == "local_friction" ? 0.2
                           : score.hypothesis->absorbed             ? bar.share_if_absorbed
                                                                    : bar.share) *
                          score.touched * smallness;
    const double most_surprise = prior_part(now);
    if (score.gain < needed && (most_surprise < enough_surprise || score.gain < enough_surprise)) continue;
    if (p > bar.p_false_alarm) continue;
    if (++tried > refitted) break;
    Candidate start = now.model;
    start.effects.push_back(at_zero(score));
    Fit fit = fitter.fit(start, whitening, iterations);
    if (!possible(fit.model.effects.back(), fit.model.axis)) continue;
    const double gain = now.cost - fit.cost, surprise = prior_part(now) - prior_part(fit);
    if (gain < needed && surprise < enough_surprise) continue;
    if (gain > best.gain) best = {std::move(fit), gain, surprise, p, score.touched};
  }
  return best;
}

/// Cost in the equations that an effect of the model has a part in.
double touched_cost(const Fitter& fitter, const Fit& fit, std::size_t effect) {
  Index column = fit.base_count();
  for (std::size_t e = 0; e < effect; ++e)
    for (const auto& p : fit.model.effects[e].hypothesis->parameters) column += p.kind != Kind::fixed;
  double cost = 0.0;
  for (const auto& s : fitter.model().segments())
    if (s.size > 0 && fit.jacobian.col(column).segment(s.start, s.size).cwiseAbs().maxCoeff() > 0.0)
      cost += fit.white.segment(s.start, s.size).squaredNorm();
  return cost;
}

/// "cogging would explain 86 % (p 1e-06), ..." for whoever waits.
std::string best_of(const Screen& screened) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(5, screened.scores.size()); ++i) {
    const auto& score = screened.scores[i];
    text += fmt::format("{}{} would explain {:.1f} % (p {:.1g})", i > 0 ? ", " : "", score.hypothesis->id,
                        100.0 * score.gain / std::max(1.0, score.touched),
                        std::max(1e-9, screened.p_false_alarm(score.standard)));
  }
  return text;
}

Candidate without(const Candidate& model, std::size_t effect) {
  Candidate less = model;
  less.effects.erase(less.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  return less;
}

}  // namespace

SearchResult search(const Fitter& fitter, const Bar& bar, const std::function<void(std::string_view)>& progress) {
  SearchResult result;
  const Candidate nominal{fitter.nominal(), {}};
  Whitening whitening = Whitening::estimate(fitter.model(), fitter.model().residual(nominal.axis, {}));
  progress("recalibrating the nominal numbers");
  Fit fit = fitter.fit_with_colour(nominal, whitening, rounds, iterations);
  result.recalibrated = fit;

  std::vector<double> chances;
  std::vector<std::vector<Score>> earlier;  // what else was in question when each was added
  while (fit.model.effects.size() < bar.most_effects) {
    progress("asking " + std::to_string(hypotheses().size()) + " hypotheses about the residual");
    result.last = screen(fitter, fit, whitening);
    progress(best_of(result.last));
    Step step = best_step(fitter, fit, whitening, result.last, bar);
    if (step.gain < 0.0) break;
    progress("adding " + std::string(step.fit.model.effects.back().hypothesis->id));
    chances.push_back(step.p);
    earlier.push_back(result.last.scores);
    fit = fitter.fit_with_colour(step.fit.model, whitening, 2, iterations);
  }

  for (std::size_t i = fit.model.effects.size(); i-- > 0;) {
    progress("doing without " + std::string(fit.model.effects[i].hypothesis->id));
    const Fit less = fitter.fit(without(fit.model, i), whitening, iterations);
    const double gain = less.cost - fit.cost, surprise = prior_part(less) - prior_part(fit);
    const double touched = touched_cost(fitter, fit, i);
    if ((gain < (fit.model.effects[i].hypothesis->absorbed ? 2.5 : 1.0) * bar.lost_when_dropped * touched &&
         surprise < bar.nominal_surprise) ||
        !possible(fit.model.effects[i], fit.model.axis)) {
      fit = fitter.fit_with_colour(less.model, whitening, 2, iterations);
      chances.erase(chances.begin() + static_cast<std::ptrdiff_t>(i));
      earlier.erase(earlier.begin() + static_cast<std::ptrdiff_t>(i));
      result.found.clear();
      i = fit.model.effects.size();
      continue;
    }
    Found found{fit.model.effects[i], gain, std::min(1.0, gain / (gain + touched)), chances[i], {}};
    std::size_t tried = 0;
    double own = 0.0;
    for (const auto& score : earlier[i])
      if (score.hypothesis == found.effect.hypothesis) own = score.gain;
    for (const auto& score : earlier[i]) {
      if (score.hypothesis == found.effect.hypothesis || score.gain < 0.8 * own) continue;
      const auto beside = std::ranges::find(result.last.scores, score.hypothesis, &Score::hypothesis);
      const bool something_else = beside != result.last.scores.end() && beside->gain > 0.3 * score.gain;
      if (something_else || ++tried > 3) continue;
      Candidate start = less.model;
      start.effects.push_back(at_zero(score));
      const Fit rival = fitter.fit(start, whitening, iterations);
      if (possible(rival.model.effects.back(), rival.model.axis) && rival.cost - fit.cost < 0.03 * gain + 15.0)
        found.rivals.push_back(score.hypothesis);
    }
    result.found.insert(result.found.begin(), found);
  }
  std::ranges::stable_sort(result.found, [](const Found& a, const Found& b) { return a.gain > b.gain; });
  result.final = std::move(fit);
  result.whitening = whitening;
  return result;
}

}  // namespace feedtwin::tools::diagnosis
