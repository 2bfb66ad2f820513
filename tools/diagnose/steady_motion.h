#pragma once
// Where an axis moves steadily one way.

#include <vector>

#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

/// Of each sample: neither about a reversal nor a rest, where friction is another than the model's in proportion to nothing,
/// nor at either end of the run.
[[nodiscard]] std::vector<bool> moves_steadily(const Track& track);

}  // namespace feedtwin::tools::diagnosis
