#pragma once
// A finding as an engineer would say it.

#include <string>
#include <string_view>

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// What is told of one of its parameters; 0 where it has none of that name.
[[nodiscard]] double value_of(const NamedEffect& effect, std::string_view name);

/// Where, what, how large with its interval, how sure, how much of the mismatch, what else could be.
[[nodiscard]] std::string sentence_of(const NamedEffect& effect);

/// What to do next and the chance that it tells; empty where nothing is open.
[[nodiscard]] std::string next_move_of(const NextExperiment& next);

/// The whole of it in one line.
[[nodiscard]] std::string summary_of(const Diagnosis& diagnosis);

}  // namespace feedtwin::tools::diagnosis
