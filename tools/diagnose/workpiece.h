#pragma once
// A line that turns with the motion, and acts along a part of the travel: a tool that cuts both ways through a workpiece.

#include <optional>
#include <utility>

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

/// Rows of the equations with the motion's sign, less what is slow and where friction turns over: a line that turns with the
/// motion is one in them that does not.
[[nodiscard]] Vector turned(const InverseModel& model, const Vector& rows);

/// From where to where along the travel a line acts, in all runs alike, each with a phase of its own; none where it acts
/// along all of it, or nearly.
/// @param rows whitened; turned
[[nodiscard]] std::optional<std::pair<double, double>> place_of_line(const InverseModel& model, const Vector& rows,
                                                                     double frequency_Hz);

}  // namespace feedtwin::tools::diagnosis
