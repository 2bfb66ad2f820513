#pragma once
// What the closed loop is asked about once more.

#include <vector>

#include "tools/diagnose/screen.h"

namespace feedtwin::tools::diagnosis {

struct Question {
  Score score;
  std::vector<double> start;  ///< if the inverse model can say little about it
};

/// What the inverse model would welcome, the most welcome first; and what it can say little about.
/// @param left what the inverse model says of every hypothesis beside the model
[[nodiscard]] std::vector<Question> questions(const Screen& left, const Candidate& model);

}  // namespace feedtwin::tools::diagnosis
