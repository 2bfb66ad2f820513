#include "tools/diagnose/forward/questions.h"

namespace feedtwin::tools::diagnosis {

std::vector<Question> questions(const Screen& left, const Candidate& model) {
  constexpr std::size_t most_asked = 4;
  constexpr double least_gain = 50.0;
  std::vector<Question> asked, untold;
  for (const auto& score : left.scores) {
    const Hypothesis& h = *score.hypothesis;
    if (has(model, h)) continue;
    for (const auto& start : h.closed_loop_starts) untold.push_back({score, start});
    if (!h.closed_loop_starts.empty()) continue;
    // what friction does at reversals is also what one bristle cannot do of any friction
    if (!(h.about_reversals && h.component != "drive") && score.gain > least_gain && asked.size() < most_asked)
      asked.push_back({score, {}});
  }
  asked.insert(asked.end(), untold.begin(), untold.end());
  return asked;
}

}  // namespace feedtwin::tools::diagnosis
