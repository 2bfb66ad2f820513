#pragma once
// What strikes once, harder than everything else pushes, bends all numbers until it no longer shows as itself.

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/diagnose/screen.h"

namespace feedtwin::tools::diagnosis {

struct Struck {
  Fit fit;                    ///< with it
  std::vector<Score> scores;  ///< of it
};

/// It is asked for beside a fit whose numbers it has not bent, and without chance's leave: signs drawn at random leave one
/// event what it is.
/// @param before fit to start from, under `colour`
/// @param now what the numbers alone leave over, under `whitening`
[[nodiscard]] std::optional<Struck> what_strikes(const Fitter& fitter, const Fit& before, const Whitening& colour,
                                                 const Fit& now, const Whitening& whitening,
                                                 const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
