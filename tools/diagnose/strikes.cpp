#include "tools/diagnose/strikes.h"

#include <fmt/format.h>

namespace feedtwin::tools::diagnosis {

std::optional<Struck> what_strikes(const Fitter& fitter, const Fit& before, const Whitening& colour, const Fit& now,
                                   const Whitening& whitening, const std::function<void(std::string_view)>& progress) {
  constexpr double asked_at = 0.2, most_left = 0.5;  // of the cost: its place is not known well, before it is fitted
  auto scores = scores_of({&hypothesis("hard_stop")}, fitter, before, colour);
  if (scores.empty() || scores.front().gain < asked_at * before.cost) return std::nullopt;
  Fit struck = fit_with(fitter, before.model, scores.front(), 0, whitening, refit_iterations);
  const Active& effect = struck.model.effects.front();
  progress(fmt::format("  {}: {:.2g} times the cost of the numbers alone", in_words(effect, struck.model.axis),
                       struck.cost / now.cost));
  if (!possible(effect, struck.model.axis) || struck.cost > most_left * now.cost) return std::nullopt;
  progress("adding " + in_words(effect, struck.model.axis));
  return Struck{std::move(struck), std::move(scores)};
}

}  // namespace feedtwin::tools::diagnosis
