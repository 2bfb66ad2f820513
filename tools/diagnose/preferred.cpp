#include "tools/diagnose/preferred.h"

#include <algorithm>

namespace feedtwin::tools::diagnosis {

const Tried& preferred(std::span<const Tried> tried) {
  constexpr double nearly = 0.7;
  const Tried& best = *std::ranges::max_element(tried, std::less{}, &Tried::value);
  const Active& first = best.fit.model.effects.back();
  if (worth_naming(first, best.fit.model.axis)) return best;
  const Tried* finding = nullptr;
  for (const auto& other : tried) {
    const Active& effect = other.fit.model.effects.back();
    if (!worth_naming(effect, other.fit.model.axis) || !easily_confused(*effect.hypothesis, *first.hypothesis)) continue;
    if (other.value > nearly * best.value && (finding == nullptr || other.value > finding->value)) finding = &other;
  }
  return finding != nullptr ? *finding : best;
}

double clearly_better(const Hypothesis& rival, const Hypothesis& named, double gain) {
  constexpr double of_any = 10.0, share_of_what_holds_it = 0.03;
  return rival.special_case == named.id ? std::max(of_any, share_of_what_holds_it * gain) : of_any;
}

}  // namespace feedtwin::tools::diagnosis
