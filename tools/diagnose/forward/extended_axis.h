#pragma once
// A hypothesis with its working parameters as the plant runs it.

#include <functional>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// The candidate's axis with its effects switched on, each number within the range that the plant gives it.
/// @param kept which effects; by default all that the plant has
[[nodiscard]] plant::AxisParameters extended(const Candidate& candidate,
                                             const std::function<bool(const Active&)>& kept = nullptr);

}  // namespace feedtwin::tools::diagnosis
