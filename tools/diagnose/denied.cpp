#include "tools/diagnose/denied.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/verdict.h"

namespace feedtwin::tools::diagnosis {
namespace {

std::vector<Suspect> named_of(const Diagnosis& result, const SearchResult& found) {
  std::vector<Suspect> named;
  for (const auto& one : found.found) {
    const auto* hypothesis = one.effect.hypothesis;
    if (std::ranges::find(result.effects, hypothesis, &NamedEffect::hypothesis) == result.effects.end()) continue;
    Candidate with = found.recalibrated.model;
    with.effects.push_back(one.effect);
    named.push_back({hypothesis, std::move(with), one.strength, one.p_false_alarm});
  }
  return named;
}

}  // namespace

bool taken_back_if_denied(Diagnosis& result, const ForwardModel& unseen, const AxisByRun& told, const SearchResult& found) {
  auto named = named_of(result, found);
  if (named.empty()) return false;
  const AxisByRun numbers_alone = extended(found.recalibrated.model);
  const double ratio = std::exp(far_off(unseen, told) - far_off(unseen, numbers_alone));
  if (ratio < denied_ratio) return false;
  result.denied_by_unseen = ratio;
  result.effects.clear();
  result.suspects = std::move(named);
  result.updated = numbers_alone.common;
  result.verdict = verdict_of(result);
  return true;
}

}  // namespace feedtwin::tools::diagnosis
