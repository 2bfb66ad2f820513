#pragma once
// A cascade for an axis whose controller nobody knows: tracks a motion on it without knowing its friction.

#include "controllers/cascade.h"
#include "plant/parameters.h"

namespace feedtwin::tools {

/// Position loop 60 1/s, velocity loop 120 1/s and 100 1/s by the mass; velocity and inertia fed forward.
[[nodiscard]] controllers::CascadeGains tracking_gains(const plant::AxisParameters& axis);

/// The stand-in of closed-loop simulation (identify/stand_in.h) as a cascade, for a recorded command that is fed forward.
[[nodiscard]] controllers::CascadeGains stand_in_gains(const plant::AxisParameters& axis);

}  // namespace feedtwin::tools
