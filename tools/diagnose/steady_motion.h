#pragma once
// Where an axis moves steadily one way, and the forces that a model leaves over there: what comes at moments of its own is
// looked for in them.

#include <vector>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// Of each sample: neither about a reversal nor a rest, where friction is another than the model's in proportion to nothing,
/// nor at either end of the run.
[[nodiscard]] std::vector<bool> moves_steadily(const Track& track);

/// Run by run and sample by sample, of all force equations together.
[[nodiscard]] std::vector<Vector> forces_left_N(const InverseModel& model, const Candidate& at);

}  // namespace feedtwin::tools::diagnosis
