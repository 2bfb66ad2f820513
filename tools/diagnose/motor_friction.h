#pragma once
// The motor's Coulomb friction along a recorded motion: with the direction at once, or over a path after each reversal.

#include "plant/parameters.h"
#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

/// Path over which it sets in, in m, as a model has it among its effects; 0: at once.
[[nodiscard]] double motor_presliding_m(const plant::AxisParameters& axis);

/// F_M, N at the table, over the sample that follows. At once: F_C tanh(v / v_0), v_0 the speed that is told from rest.
/// Over a path: the plant's own bristle (Dahl 1968, plant/effects/motor_presliding.h), followed along the recorded motion.
[[nodiscard]] Vector motor_coulomb_N(const Track& track, const plant::AxisParameters& axis);

}  // namespace feedtwin::tools::diagnosis
