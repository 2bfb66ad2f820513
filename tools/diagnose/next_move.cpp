#include "tools/diagnose/next_move.h"

#include <algorithm>
#include <vector>

#include "tools/diagnose/sentence.h"

namespace feedtwin::tools::diagnosis {

void plan_next(Diagnosis& result, const Evidence& seen, const std::function<void(std::string_view)>& progress) {
  const auto open = std::ranges::find_if(result.effects, [](const NamedEffect& e) { return !e.alternatives.empty(); });
  if (open != result.effects.end()) {
    result.next = plan_to_separate(seen, *open->hypothesis, open->alternatives, progress);
    open->sentence += next_move_of(result.next);
  } else if (result.verdict == "cannot-tell" && result.denied_by_unseen == 0.0) {
    std::vector<Candidate> models;
    for (const auto& suspect : result.suspects) models.push_back(suspect.model);
    result.next = plan_to_prove(seen, models, progress);
  }
}

}  // namespace feedtwin::tools::diagnosis
