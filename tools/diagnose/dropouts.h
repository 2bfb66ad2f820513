#pragma once
// A torque that fails for moments: a loose plug, a gate that drops out, a worn brush. At moments of their own, some
// milliseconds long, the axis lacks a share of what was commanded, always the same one. That repeats over nothing, so that
// no table holds it, and an average over 4 ms rows makes noise of it; but no noise is in proportion to the command.

#include <cstddef>
#include <optional>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

struct Dropouts {
  double share = 0.0;                  ///< of the commanded torque that fails
  std::size_t moments = 0;             ///< at which it was seen to
  double first_s = 0.0, last_s = 0.0;  ///< within a run, of all runs
};

/// While the axis moves steadily one way, on the runs' own samples.
/// @return none of fewer than eight moments, or where a fifth of them lacks another share
[[nodiscard]] std::optional<Dropouts> dropouts_of(const InverseModel& model, const Candidate& at);

/// Without names and with those of the inverse model, which then stand for it: no simulation is needed to see that. A
/// damaged spot looks like it until it is named.
[[nodiscard]] bool torque_fails_for_moments(const InverseModel& model, const Candidate& recalibrated,
                                            const Candidate& named);

}  // namespace feedtwin::tools::diagnosis
