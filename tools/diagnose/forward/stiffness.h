#pragma once
// How stiff the screw is, where a force or torque sensor is recorded: no screw is rigid, and the table swings on it after
// every jump of the command. The inverse model has one body where no scale shows the other, and calls such a sensor late;
// with a scale it takes a screw that yields by less than the scale's step for a rigid one.

#include <functional>
#include <optional>
#include <string_view>

#include "tools/diagnose/forward/ruling.h"

namespace feedtwin::tools::diagnosis {

/// Gives the model a screw that yields, where in closed loop the runs are clearly likelier with it; the name of a late force
/// sensor goes where they are. The stiffness itself is not told: by its swing alone one is easily taken for another.
/// @return the fit's model as the closed loop has it; none where it was not asked
std::optional<Ruling> ask_how_stiff(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                                    const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
