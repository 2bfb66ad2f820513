#include "tools/diagnose/next_experiment.h"

#include "plant/effects/registry.h"

namespace feedtwin::tools::diagnosis {

void plan_next(Diagnosis& result) {
  for (const auto& effect : result.effects) {
    if (effect.alternatives.empty()) continue;
    result.next_separates = effect.alternatives;
    result.next_separates.insert(result.next_separates.begin(), std::string(effect.hypothesis->id));
    if (const auto* entry = plant::find_effect(effect.hypothesis->id)) result.next_move = entry->exciting_move;
    return;
  }
}

}  // namespace feedtwin::tools::diagnosis
