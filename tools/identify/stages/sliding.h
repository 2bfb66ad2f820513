#pragma once
// Stage (b): what resists in sliding far above the Stribeck velocity is linear in its coefficients.
//
//   F = m a + s (F_C,s + mu_s |v|),   s the direction of motion
//
// For the motor (Eq. 12: k (T_C - T_I)) this is the whole law, with m = J_M k^2, mu = B_M k^2 and F_C = F_M; for screw and
// guide it gives the mass that their Stribeck curves are freed of.

#include <optional>
#include <span>
#include <vector>

#include "plant/parameters.h"
#include "tools/identify/stages/component_forces.h"

namespace feedtwin::tools {

struct SlidingFit {
  double mass_kg = 0.0;
  plant::Directional coulomb_N, viscous_Ns_per_m;
  double mass_deviation_kg = 0.0;
  double rms_N = 0.0;  ///< of what is left
};

/// Samples faster than `slowest_m_per_s` and further than `settled_m` from the last reversal. Nothing where there are too
/// few of them or they do not tell the five apart.
[[nodiscard]] std::optional<SlidingFit> fit_sliding(std::span<const ComponentForces> runs,
                                                    std::vector<double> ComponentForces::* component, double slowest_m_per_s,
                                                    double settled_m);

}  // namespace feedtwin::tools
