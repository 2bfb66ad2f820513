#pragma once
// A line that turns with the motion, and acts along a part of the travel: a tool that cuts through a workpiece, both ways or
// one way alone.

#include <optional>

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

/// Rows of the equations with the motion's sign, less what is slow and where friction turns over: a line that turns with the
/// motion is one in them that does not.
[[nodiscard]] Vector turned(const InverseModel& model, const Vector& rows);

/// Where a tool cuts; only_direction 1 or -1 where the table comes back in the air, otherwise 0.
struct Workpiece {
  double from_m = 0.0, to_m = 0.0, only_direction = 0.0;
};

/// From where to where along the travel a line acts, and which way, in all runs alike, each with a phase of its own; none
/// where it acts along all of it, or nearly.
/// @param rows whitened; turned
[[nodiscard]] std::optional<Workpiece> place_of_line(const InverseModel& model, const Vector& rows, double frequency_Hz);

}  // namespace feedtwin::tools::diagnosis
