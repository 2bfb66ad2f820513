#pragma once
// A Stribeck velocity that is several times off has an optimum of its own, which no small step finds.

#include <functional>
#include <optional>
#include <string_view>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// The best fit from velocities four and sixteen times as large, where that is worth it.
[[nodiscard]] std::optional<Fit> with_wider_stribeck(const Fitter& fitter, const Fit& fit, const Whitening& whitening,
                                                     const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
