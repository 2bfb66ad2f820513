#pragma once
// How much of the command's jump the sensors show at once. Where motor, screw and table are one body, each takes its
// share by mass, and a sensor that reads at the sample's instant is half a tick ahead of the mean about it. Behind a screw
// that yields the force can't jump: read as one body, the sensor looks 0.4 to 1.2 ms late, as it does on no rigid axis; a
// sensor that is late by as much leaves clearly less over if it is read as that.
//
// The torque sensor then shows at once what the screw's inertia takes of a jump that moves motor and screw alone. Where the
// table is heavy it looks a tenth to a quarter of a millisecond late, and a fit of one body pays with its numbers.

#include <vector>

#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

// Many controllers read their sensors first and then set the command: such a row shows nothing of its own jump, and what it
// would have shown of the one before is a sample late.

/// Of what one body would show: 1, or less where the recordings say so. 1 without the sensor.
[[nodiscard]] JumpShares jump_shares(const std::vector<Recording>& runs, const plant::AxisParameters& nominal);

}  // namespace feedtwin::tools::diagnosis
