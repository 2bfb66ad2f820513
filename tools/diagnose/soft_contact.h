#pragma once
// Pre-sliding memory that a softened bristle hides: the fit gives a contact that yields over many micrometres to bristle and
// memory alike, and measured by that bristle the memory is nothing of its own. The file's bristle tells.

#include <optional>

#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/fit.h"
#include "tools/diagnose/hypothesis.h"

namespace feedtwin::tools::diagnosis {

/// Is it worth naming by the model's numbers, or a memory that only a bristle many times as soft as the file's makes small?
/// @param now, nominal numbers of the model, and of the axis file
[[nodiscard]] bool worth_telling(const Active& active, const plant::AxisParameters& now,
                                 const plant::AxisParameters& nominal);

/// The same where no memory was asked for, since the bristle alone makes most of it: a sixth of the file's stiffness is no
/// wrong number. Contacts of slipping elements with nothing hidden left one of 0.205 at least, hidden memories 0.03 to
/// 0.157.
/// @param told with its names and recalibrated numbers
/// @return none where another name of what happens before sliding is told
[[nodiscard]] std::optional<NamedEffect> memory_in_the_bristle(const Diagnosis& told, const Fit& fit);

}  // namespace feedtwin::tools::diagnosis
