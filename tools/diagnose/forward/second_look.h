#pragma once
// What the closed loop still misses is asked about again: an effect that the inverse model would welcome but finds too weak
// to name (its numbers take most of it up) may be all that a channel is off by once everything is simulated.

#include <functional>
#include <optional>
#include <string_view>

#include "tools/diagnose/forward/ruling.h"

namespace feedtwin::tools::diagnosis {

/// Adds to the names what brings a channel clearly closer, in all runs; what it changes is changed in both.
/// @param settled the fit's model as the closed loop has it, if it was asked before
/// @return the same with what was added
[[nodiscard]] std::optional<Ruling> look_again(const ForwardModel& forward, const Fitter& fitter, SearchResult& found,
                                               Fit& fit, const std::optional<Ruling>& settled,
                                               const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
