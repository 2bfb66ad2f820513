#include "tools/diagnose/denied.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/verdict.h"

namespace feedtwin::tools::diagnosis {
namespace {

bool is_named(const Diagnosis& result, const Found& one) {
  return std::ranges::find(result.effects, one.effect.hypothesis, &NamedEffect::hypothesis) != result.effects.end();
}

std::vector<Suspect> named_of(const Diagnosis& result, const SearchResult& found) {
  std::vector<Suspect> named;
  for (const auto& one : found.found) {
    if (!is_named(result, one)) continue;
    Candidate with = found.recalibrated.model;
    with.effects.push_back(one.effect);
    named.push_back({one.effect.hypothesis, std::move(with), one.strength, one.p_false_alarm});
  }
  return named;
}

/// Do the names do enough on unseen runs, in a channel that is farther off with them, to have brought it there? Otherwise it
/// is the numbers beside them.
bool brought_it_there(const Diagnosis& result) {
  return std::ranges::any_of(result.holdout, [&](const auto& one) {
    const auto& [channel, error] = one;
    const double more = error.after * error.after - error.recalibrated * error.recalibrated;
    const auto by_force = result.holdout_inverse.find(channel);
    return more > 0.0 && by_force != result.holdout_inverse.end() &&
           by_force->second.by_effects > least_share_of_harm * std::sqrt(more);
  });
}

}  // namespace

double times_as_far_off(const std::map<std::string, ChannelFigures>& unseen, double ChannelFigures::* than) {
  constexpr double nothing = 1e-12;
  double sum = 0.0;
  for (const auto& [channel, error] : unseen)
    sum += std::log(std::max(nothing, error.after) / std::max(nothing, error.*than));
  return std::exp(sum / static_cast<double>(std::max<std::size_t>(1, unseen.size())));
}

bool taken_back_if_denied(Diagnosis& result, const SearchResult& found) {
  const double ratio = times_as_far_off(result.holdout, &ChannelFigures::recalibrated);
  auto named = named_of(result, found);
  const auto is_number = [](const Suspect& one) { return one.hypothesis->number_of_the_model; };
  const double most = std::ranges::all_of(named, is_number) ? numbers_denied_ratio : denied_ratio;
  if (named.empty() || result.unknown || ratio < most) return false;
  if (!brought_it_there(result)) return false;
  if (times_as_far_off(result.holdout_inverse, &ChannelFigures::recalibrated) < borne_out_ratio) return false;
  const auto is_plain = [&](const Found& one) { return one.error_ratio > beyond_denial_ratio && is_named(result, one); };
  if (ratio < much_farther_off && std::ranges::any_of(found.found, is_plain)) return false;
  result.denied_by_unseen = ratio;
  result.effects.clear();
  result.suspects = std::move(named);
  result.updated = extended(found.recalibrated.model).common;
  result.verdict = verdict_of(result);
  return true;
}

bool left_out_if_of_harm(Diagnosis& result, const SearchResult& found) {
  constexpr double farther = 1.02;
  if (!result.effects.empty() || (result.unknown && result.unknown->mode)) return false;
  const auto worse = [](const auto& channel) { return channel.second.after > farther * channel.second.recalibrated; };
  const bool of_harm = result.unknown ? times_as_far_off(result.holdout, &ChannelFigures::recalibrated) > farther
                                      : std::ranges::any_of(result.holdout, worse);
  if (!of_harm) return false;
  result.updated = extended(found.recalibrated.model).common;
  return true;
}

}  // namespace feedtwin::tools::diagnosis
