#include "tools/diagnose/suspects.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "tools/diagnose/judge.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t most_asked = 4;
constexpr double share_of_strength = 0.7;  // of what it takes to be named

bool can_be_suspected(const Score& score, const plant::AxisParameters& axis, const Screen& left, const Bar& bar) {
  const Hypothesis& h = *score.hypothesis;
  return !h.absorbed && !h.number_of_the_model && worth_naming({&h, score.q}, axis) && score.gain > bar.gain &&
         left.p_false_alarm(score.standard) < bar.p_false_alarm;
}

/// Does it hold on time that it was not fitted to?
bool holds(const InverseModel& model, const Fit& with, const Fit& without, const Bar& bar) {
  const auto gains = gains_by_fold(model, with, without, bar.folds);
  const double on_unseen = std::accumulate(gains.begin(), gains.end(), 0.0);
  const auto that_gain = static_cast<std::size_t>(std::ranges::count_if(gains, [](double g) { return g > 1.0; }));
  return on_unseen > 0.5 * (without.cost - with.cost) && 4 * that_gain >= 3 * bar.folds;
}

}  // namespace

std::vector<Suspect> suspects(const Fitter& fitter, const SearchResult& found, const Fit& fit,
                              const std::function<void(std::string_view)>& progress) {
  const Bar bar = bar_for(fitter.nominal());
  std::vector<Suspect> all;
  std::size_t tried = 0;
  for (const auto& score : found.last.scores) {
    if (!can_be_suspected(score, fit.model.axis, found.last, bar)) continue;
    if (++tried > most_asked) break;
    const Fit with = fit_with(fitter, fit.model, score, fit.model.effects.size(), found.whitening, refit_iterations);
    const Active& active = with.model.effects.back();
    const auto& h = *score.hypothesis;
    if (!possible(active, with.model.axis) || !worth_naming(active, with.model.axis)) continue;
    const double strong = strength(fitter.model(), with, fit, h.about_reversals, bar);
    const bool held = holds(fitter.model(), with, fit, bar);
    progress(fmt::format("suspected: {} (strength {:.2f}, p {:.1g}{})", h.id, strong,
                         found.last.p_false_alarm(score.standard), held ? "" : ", not on unseen folds"));
    if (held && strong > share_of_strength * h.least_strength)
      all.push_back({&h, with.model, strong, found.last.p_false_alarm(score.standard)});
  }
  std::ranges::stable_sort(all, [](const Suspect& a, const Suspect& b) { return a.strength > b.strength; });
  return all;
}

}  // namespace feedtwin::tools::diagnosis
