#pragma once
// What no model can explain of a held-out run: the same motion of the same axis with the same effects, recorded again with
// every noise drawn anew (encoder's grid, sensors, disturbance, bursts). Two such runs differ by sqrt(2) times what a
// perfect model would leave of either.

#include <string>
#include <vector>

#include "tests/challenge/catalogue.h"
#include "tests/challenge/closed_loop.h"

namespace feedtwin::challenge {

/// |y - s| / |y - mean y| of one channel, as `diagnose` reports it: power at the meter's readings, the scale as what it
/// shows beyond the encoder without its mean, over its travel.
struct ChannelFloor {
  std::string channel;
  double floor = 0.0;   ///< that a perfect model leaves
  double effect = 0.0;  ///< by which the hidden effects move the channel, noise and numbers being the same
};

/// The run once more, all its noise from generators of its own. Same seed, same run.
[[nodiscard]] Run record_again(const Axis& axis, const Effects& effects, const Noise& noise, const Gains& gains,
                               const MotionPlan& plan, std::uint64_t seed);

/// @param without the run without the effects, with the noise of `run`
/// @param channels that the case records, beside command and encoder
[[nodiscard]] std::vector<ChannelFloor> floors_of(const Run& run, const Run& again, const Run& without, unsigned channels);

}  // namespace feedtwin::challenge
