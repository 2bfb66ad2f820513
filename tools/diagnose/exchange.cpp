#include "tools/diagnose/exchange.h"

#include <algorithm>

#include "tools/diagnose/judge.h"
#include "tools/diagnose/preferred.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t rivals_tried = 4;

double gain_then(const std::vector<Score>& earlier, const Hypothesis* hypothesis) {
  const auto own = std::ranges::find(earlier, hypothesis, &Score::hypothesis);
  return own == earlier.end() ? 0.0 : own->gain;
}

/// The fit's last effect in this place.
Candidate in_place(const Fit& fit, std::size_t place) {
  Candidate swapped = fit.model;
  auto& effects = swapped.effects;
  std::rotate(effects.begin() + static_cast<std::ptrdiff_t>(place), effects.end() - 1, effects.end());
  return swapped;
}

}  // namespace

std::optional<Exchange> exchanged(const Fitter& fitter, const Bar& bar, const Whitening& whitening, const Placed& named,
                                  const Screen& last, const std::set<const Hypothesis*>& never,
                                  std::vector<const Hypothesis*>& rivals) {
  constexpr double share_of_own = 0.7;  // of what it scored itself, for a rival to be refitted
  const Hypothesis& own = *named.with.model.effects[named.effect].hypothesis;
  std::size_t tried = 0;
  for (const auto& score : named.earlier) {
    const auto* rival = score.hypothesis;
    if (has(named.with.model, *rival) || never.contains(rival)) continue;
    if (score.gain < share_of_own * gain_then(named.earlier, &own) || last.leaves_to(score) || ++tried > rivals_tried)
      continue;
    const Fit fit = fit_with(fitter, named.less.model, score, named.less.model.effects.size(), whitening, refit_iterations);
    const Active& other = fit.model.effects.back();
    if (!worth_naming(other, fit.model.axis) || !possible(other, fit.model.axis)) continue;
    const auto verdict = judged(fitter, fit, named.less, *rival, bar);
    if (!verdict.enough || !may_be_missed_enough(other, verdict.gain)) continue;
    const double more = bar.per_parameter * (static_cast<double>(freedom(*rival)) - static_cast<double>(freedom(own)));
    const double worse = fit.cost + more - named.with.cost;
    if (worse < -clearly_better(*rival, own, named.gain)) return Exchange{in_place(fit, named.effect), &score};
    if (worse < std::min(0.03 * named.gain, 0.005 * named.with.cost) + 15.0) rivals.push_back(rival);
  }
  return std::nullopt;
}

}  // namespace feedtwin::tools::diagnosis
