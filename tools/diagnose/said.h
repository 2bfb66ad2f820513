#pragma once
// What an effect says along a run, kept with what it looked at of the model for that: beside a model that is the same there
// it need not be asked again.

#include "tools/diagnose/hypothesis.h"

namespace feedtwin::tools::diagnosis {

/// What two models have in common.
using Alike = View::Seen;

struct Said {
  Contribution adds;
  View::Seen seen;
};

[[nodiscard]] Said said_by(const Active& effect, const View& view);
/// Of the same effect with the same numbers.
[[nodiscard]] bool says_the_same(const View::Seen& seen, const Alike& alike);

}  // namespace feedtwin::tools::diagnosis
