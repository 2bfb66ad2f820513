#pragma once
// What to record next, where the data leave a question open.

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// Sets the move and what it separates.
void plan_next(Diagnosis& result);

}  // namespace feedtwin::tools::diagnosis
