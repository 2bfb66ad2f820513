#pragma once
// A force that is on or off, at moments of its own: a clamp, a neighbour's vacuum, or against the motion a brake that
// sticks, a chip in the guide. No table holds it, for it repeats over nothing; but what it leaves over has two values and
// hardly any between, which no noise has, however coloured.

#include <cstddef>
#include <optional>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

struct Switching {
  double force_N = 0.0;  ///< between the two values
  double share = 0.0;    ///< of what is left over that they hold: a line along all its values 0.75, normal noise 0.64
  std::size_t switches = 0;
  double first_s = 0.0, last_s = 0.0;  ///< within a run, of all runs
  bool opposes = false;                ///< the motion, whichever way it goes
};

/// Of the sum of the forces while the axis moves steadily one way, both ways alike: as it is, or against the motion.
/// @return none where it has other values too, or switches fewer than eight times
[[nodiscard]] std::optional<Switching> switching_of(const InverseModel& model, const Candidate& at);

/// Without names and with those of the inverse model, which then stand for it.
[[nodiscard]] bool force_switches(const InverseModel& model, const Candidate& recalibrated, const Candidate& named);

}  // namespace feedtwin::tools::diagnosis
