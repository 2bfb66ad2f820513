#pragma once
// Which of several hypotheses that passed the bar comes into the model first, and when one takes another's place.

#include <span>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// A hypothesis that passed the bar, in the model: its effects' last.
struct Tried {
  Fit fit;
  double value = 0.0;  ///< gain less what its parameters are charged
  double p_false_alarm = 1.0;
};

/// The one that explains most; but a nuisance waits while a finding that it could be mistaken for explains nearly as much:
/// it comes in after it, where it is there too.
/// @param tried at least one
[[nodiscard]] const Tried& preferred(std::span<const Tried> tried);

/// So much less must a rival leave over to take a name's place: what holds the named one as a special case fits a little
/// more of whatever there is.
/// @param gain what the named one explains
[[nodiscard]] double clearly_better(const Hypothesis& rival, const Hypothesis& named, double gain);

}  // namespace feedtwin::tools::diagnosis
