#pragma once
// The one word that a diagnosis comes to.

#include <functional>
#include <string_view>

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// Is physics missing from the model, or something in the set-up wrong? A wrong number is neither.
[[nodiscard]] bool anything_missing(const Diagnosis& result);

/// Of what was named and recalibrated.
[[nodiscard]] const char* verdict_of(const Diagnosis& result);

/// Is too much of what the recalibrated model leaves over structure that the named effects do not explain?
[[nodiscard]] bool beyond_the_catalogue(const Fitter& fitter, const SearchResult& found, const Candidate& final,
                                        const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
