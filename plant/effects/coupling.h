#pragma once
// placeholder
#include "plant/effects/effect.h"

namespace feedtwin::plant {

/// Two couplings one after the other: gaps add, springs and dampers give together. A stiffness of 0 stands for none yet.
[[nodiscard]] inline CouplingParameters in_series(const CouplingParameters& a, const CouplingParameters& b) noexcept {
  if (a.stiffness_N_per_m == 0.0) return b;
  const auto together = [](double one, double other) { return one + other > 0.0 ? one * other / (one + other) : 0.0; };
  return {a.gap_m + b.gap_m, together(a.stiffness_N_per_m, b.stiffness_N_per_m),
          together(a.damping_Ns_per_m, b.damping_Ns_per_m)};
}

}  // namespace feedtwin::plant
