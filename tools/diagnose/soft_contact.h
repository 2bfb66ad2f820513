#pragma once
// Pre-sliding memory that a softened bristle hides: the fit gives a contact that yields over many micrometres to bristle and
// memory alike, and measured by that bristle the memory is nothing of its own. The file's bristle tells.

#include "tools/diagnose/hypothesis.h"

namespace feedtwin::tools::diagnosis {

/// Is it worth naming by the model's numbers, or a memory that only a bristle many times as soft as the file's makes small?
/// @param now, nominal numbers of the model, and of the axis file
[[nodiscard]] bool worth_telling(const Active& active, const plant::AxisParameters& now,
                                 const plant::AxisParameters& nominal);

}  // namespace feedtwin::tools::diagnosis
