#pragma once
// A hypothesis with its working parameters as the plant runs it.

#include <functional>

#include "tools/diagnose/fit.h"
#include "tools/diagnose/forward/axis_by_run.h"

namespace feedtwin::tools::diagnosis {

/// Which effects, on an axis.
using Kept = std::function<bool(const Active& active, const plant::AxisParameters& axis)>;

/// The candidate's axis with its effects switched on, each number within the range that the plant gives it.
/// @param kept which effects; by default all that the plant has
[[nodiscard]] AxisByRun extended(const Candidate& candidate, const Kept& kept = nullptr);
/// What a run may be simulated with: the effects worth naming and, where there are nuisances, these with them, since
/// friction may rest on one.
[[nodiscard]] std::vector<AxisByRun> ways_of(const Candidate& candidate);
/// An axis that has effects of this model, with the phases that the model's lines have in each run.
[[nodiscard]] AxisByRun with_phases_of(const Candidate& model, plant::AxisParameters axis);

}  // namespace feedtwin::tools::diagnosis
