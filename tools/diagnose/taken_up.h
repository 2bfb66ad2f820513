#pragma once
// What mass and friction could still take up of a force that is left over. Disturbances move an axis in closed loop, so that
// they are not independent of its acceleration: they draw the inverse model's numbers aside, and what that leaves over
// follows the motion without being missing physics.

#include <span>

#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

/// About a sample, over 12 ms: without the encoder's grid.
[[nodiscard]] double slow_acceleration_m_per_s2(const Track& track, Index sample);

/// A row a moment: acceleration; by direction of motion speed, one, and exp(-|v| / 2 mm/s). (n x 7)
[[nodiscard]] Eigen::MatrixXd columns_of_numbers(std::span<const double> acceleration_m_per_s2,
                                                 std::span<const double> velocity_m_per_s);

}  // namespace feedtwin::tools::diagnosis
