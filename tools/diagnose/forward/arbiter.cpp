#include "tools/diagnose/forward/arbiter.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/likeliest_start.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// A rival that the inverse model finds this much worse, as a share of what the named one brings, is not simulated.
constexpr double hopeless = 0.5;

}  // namespace

Between between(const Hypothesis& named, const Hypothesis& rival, double better_nats, bool clear) {
  if (clear) return better_nats < 0.0 ? Between::named_stays : Between::rival_takes_the_place;
  if (named.special_case == rival.id && better_nats >= 0.0) return Between::rival_takes_the_place;
  if (rival.special_case == named.id && better_nats < of_consequence_nats) return Between::named_stays;
  return Between::both_in_question;
}

bool Arbiter::exchanged(SearchResult& found, Fit& fit, Ruling& now, std::size_t e,
                        std::vector<const Hypothesis*>& beaten) const {
  const auto* named = fit.model.effects[e].hypothesis;
  Found* const entry = found.of(named);
  // a nuisance only says how the channels read: no name may come of it
  if (entry == nullptr || !can_be_named(fit.model.effects[e], fit.model.axis)) return false;
  std::vector<const Hypothesis*> asked = entry->rivals;
  for (const auto& other : hypotheses())
    if (easily_confused(*named, other) && std::ranges::find(asked, &other) == asked.end()) asked.push_back(&other);
  std::erase_if(asked, [&](const Hypothesis* other) {
    return has(fit.model, *other) || std::ranges::find(beaten, other) != beaten.end();
  });
  const Fit less = fitter_.fit(without(fit.model, e), found.whitening, refit_iterations);
  for (const auto& score : scores_of(asked, fitter_, less, found.whitening)) {
    std::erase(entry->rivals, score.hypothesis);
    if (score.gain <= 0.0) continue;
    Fit other = fit_with(fitter_, less.model, score, e, found.whitening, refit_iterations);
    if (other.cost - fit.cost > hopeless * (less.cost - fit.cost) || !can_be_named(other.model.effects[e], other.model.axis))
      continue;
    other.model = at_likeliest_start(forward_, other.model);
    Ruling rival = rule_beside(now, other, forward_, fitter_, SlopesOf::anew, now.value);
    if (!can_be_named(rival.model.effects[e], rival.model.axis)) continue;
    contest(now, rival, forward_, fitter_);
    if (!can_be_named(rival.model.effects[e], rival.model.axis)) continue;
    const auto difference = compared(rival.likelihood, now.likelihood);
    const double better = rival.value - now.value;
    progress_(fmt::format("closed loop, {} in place of {}: {:+.0f} nats, {:+.1f} deviations", score.hypothesis->id,
                          named->id, better, difference.deviations));
    const bool can_tell = !alike(now.model.effects[e], rival.model.effects[e], fitter_.model().tracks().front().sample_s);
    const bool clear = can_tell && std::abs(better) > clearly_nats &&
                       std::copysign(difference.deviations, better) == difference.deviations &&
                       std::abs(difference.deviations) > clearly_deviations;
    const Between found_between = between(*named, *score.hypothesis, better, clear);
    if (found_between == Between::both_in_question) entry->rivals.push_back(score.hypothesis);
    if (found_between != Between::rival_takes_the_place || spoils_a_channel(forward_, rival.model, now.fit.model)) continue;
    beaten.push_back(named);
    entry->effect = rival.model.effects[e];
    entry->rivals.clear();
    fit = rival.fit;
    now = rival;
    return true;
  }
  return false;
}

std::optional<Ruling> Arbiter::settle(SearchResult& found, Fit& fit, std::optional<Ruling> before) const {
  if (found.found.empty()) return before;
  constexpr int most_exchanges = 3;
  if (!before) fit.model = at_likeliest_start(forward_, fit.model);
  Ruling now = before ? std::move(*before) : rule(fit, forward_, fitter_);
  std::vector<const Hypothesis*> beaten;
  int exchanges = 0;
  for (std::size_t e = 0; e < fit.model.effects.size();) {
    const bool again = exchanges < most_exchanges && exchanged(found, fit, now, e, beaten);
    if (again) ++exchanges;
    e = again ? 0 : e + 1;
  }
  return now;
}

}  // namespace feedtwin::tools::diagnosis
