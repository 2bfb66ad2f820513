#include "tools/diagnose/search.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr int rounds = 3, iterations = 6;
constexpr std::size_t refitted = 4;

double prior_part(const Fit& fit) {
  return fit.white.tail(fit.base_count()).squaredNorm();
}

bool possible(const Active& active, const plant::AxisParameters& axis) {
  return active.hypothesis->admissible == nullptr || active.hypothesis->admissible(active.q, axis);
}

struct Step {
  Fit fit;
  double gain = -1.0, surprise = 0.0, p = 1.0;
};

/// The best of the hypotheses that pass the bar, refitted jointly.
Step best_step(const Fitter& fitter, const Fit& now, const Whitening& whitening, const Screen& screened, const Bar& bar) {
  Step best;
  std::size_t tried = 0;
  for (const auto& score : screened.scores) {
    const double p = screened.p_false_alarm(score.standard);
    const double most_surprise = prior_part(now);
    if (score.gain < bar.share * now.cost && (most_surprise < bar.nominal_surprise || score.gain < bar.nominal_surprise))
      continue;
    if (p > bar.p_false_alarm) continue;
    if (++tried > refitted) break;
    Candidate start = now.model;
    start.effects.push_back(at_zero(score));
    Fit fit = fitter.fit(start, whitening, iterations);
    if (!possible(fit.model.effects.back(), fit.model.axis)) continue;
    const double gain = now.cost - fit.cost, surprise = prior_part(now) - prior_part(fit);
    if (gain < bar.share * now.cost && surprise < bar.nominal_surprise) continue;
    if (gain > best.gain) best = {std::move(fit), gain, surprise, p};
  }
  return best;
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
  while (fit.model.effects.size() < bar.most_effects) {
    progress("asking " + std::to_string(hypotheses().size()) + " hypotheses about the residual");
    result.last = screen(fitter, fit, whitening);
    Step step = best_step(fitter, fit, whitening, result.last, bar);
    if (step.gain < 0.0) break;
    progress("adding " + std::string(step.fit.model.effects.back().hypothesis->id));
    chances.push_back(step.p);
    fit = fitter.fit_with_colour(step.fit.model, whitening, 2, iterations);
  }

  for (std::size_t i = fit.model.effects.size(); i-- > 0;) {
    progress("doing without " + std::string(fit.model.effects[i].hypothesis->id));
    const Fit less = fitter.fit(without(fit.model, i), whitening, iterations);
    const double gain = less.cost - fit.cost, surprise = prior_part(less) - prior_part(fit);
    if ((gain < bar.lost_when_dropped * less.cost && surprise < bar.nominal_surprise) ||
        !possible(fit.model.effects[i], fit.model.axis)) {
      fit = fitter.fit_with_colour(less.model, whitening, 2, iterations);
      chances.erase(chances.begin() + static_cast<std::ptrdiff_t>(i));
      result.found.clear();
      i = fit.model.effects.size();
      continue;
    }
    Found found{fit.model.effects[i], gain, gain / less.cost, chances[i], {}};
    const Screen others = screen(fitter, less, whitening);
    std::size_t tried = 0;
    for (const auto& score : others.scores) {
      if (score.hypothesis == found.effect.hypothesis || score.gain < 0.8 * gain || ++tried > 3) continue;
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
