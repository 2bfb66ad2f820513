#pragma once
// What a diagnosis leaves open, and the move that would tell.

#include <functional>
#include <string_view>

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// Of a name that the channels do not tell from others, or of what is too weak to be named; into the result.
void plan_next(Diagnosis& result, const Evidence& seen, const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
