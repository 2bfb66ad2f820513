#pragma once
// One run of the true drive under a controller of its own, as its sensors record it.

#include <cstdint>

#include "tests/challenge/motion.h"
#include "tests/challenge/truth.h"

namespace feedtwin::challenge {

/// Position P, velocity PI, feed-forward; sampled at 1 kHz on the counted position.
struct Gains {
  double position_per_s = 50.0, velocity_Ns_per_m = 9000.0, integral_N_per_m = 2.0e5;
  double velocity_feedforward = 1.0, acceleration_feedforward_kg = 0.0;
};

/// Same seed, same run.
[[nodiscard]] Run record(const Axis& axis, const Effects& effects, const Noise& noise, const Gains& gains,
                         const MotionPlan& plan, std::uint64_t seed);

}  // namespace feedtwin::challenge
