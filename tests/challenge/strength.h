#pragma once
// How strong a hidden effect is: what it leaves in the torque command beyond what refitted nominal numbers take up,
// as a multiple of what is left without it.

#include <vector>

#include "tests/challenge/truth.h"

namespace feedtwin::challenge {

/// What a fit of mass, viscous and sliding friction by direction leaves of the force command, rms over all runs, N;
/// both sides are averaged over 15 ms, and only samples count that have slid for 40 ms.
struct Leftover {
  double rms_N;
  std::vector<double> numbers;  ///< mass, viscous +-, sliding +-, Stribeck +- : the fit itself
};
[[nodiscard]] Leftover leftover(const std::vector<Run>& runs, double lead_m);

}  // namespace feedtwin::challenge
