#pragma once
// What was ruled before: the same model, polished the same way, ends in the same place, so it is not polished twice. Who is
// ahead is asked by the confirmation, the arbiter and the second look, often of the same two explanations.

#include <utility>
#include <vector>

#include "tools/diagnose/forward/ruling.h"

namespace feedtwin::tools::diagnosis {

/// Of polishing: the first explanation once and well, since the last polish goes on from there; others from good numbers.
inline constexpr int first_iterations = 8, further_iterations = 3;

/// How a model is polished.
struct PolishWay {
  int most_iterations = further_iterations;
  SeenSlopes known{};               ///< of an explanation beside it; none: seen anew
  bool of_effects = false;          ///< are those of the effects' numbers known too?
  double least_promise_nats = 0.0;  ///< of the last effect: where slopes promise less, nothing is polished
  double ahead = none_ahead;        ///< value of the explanation that it is compared with

  bool operator==(const PolishWay&) const = default;
};

/// All that a polish depends on, beside the runs.
struct PolishQuestion {
  plant::AxisParameters nominal;
  Candidate start;
  PolishWay way;

  bool operator==(const PolishQuestion&) const = default;
};

class RulingsBefore {
 public:
  /// nullptr: not asked before. Its fit is empty: that is the asker's own.
  [[nodiscard]] const Ruling* answer(const PolishQuestion& question) const {
    for (const auto& [asked, ruling] : all_)
      if (asked == question) return &ruling;
    return nullptr;
  }
  void note(PolishQuestion question, Ruling ruling) {
    ruling.fit = {};
    all_.emplace_back(std::move(question), std::move(ruling));
  }

 private:
  std::vector<std::pair<PolishQuestion, Ruling>> all_;
};

}  // namespace feedtwin::tools::diagnosis
