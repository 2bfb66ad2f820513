#pragma once
// When a tool comes into the cut and leaves it, to a sample: where the force on the table steps, and over what.

#include <vector>

#include "tools/diagnose/windows.h"

namespace feedtwin::tools::diagnosis {

struct Cuts {
  std::vector<Windows> windows;  ///< by run
  double ramp_s = 0.0;           ///< all edges'
};

/// Each edge moved, by less than a line's envelope is wide, to where a step of the mean force and of the line explains most
/// of the residual about it; the ramp is what explains most of all of them. An edge that nothing shows stays, and so does
/// one that would run away: friction turns round there, or holds the table.
/// @param residual without what cuts
[[nodiscard]] Cuts sharpened(const InverseModel& model, const Vector& residual, double frequency_Hz,
                             std::vector<Windows> windows);

}  // namespace feedtwin::tools::diagnosis
