#pragma once
// One row of the log: what a tick measured, was told and did. Plain data, handed from the tick to a writer.

#include <cstdint>

#include "io/port.h"
#include "plant/signals.h"

namespace feedtwin::rt {

/// One axis in one tick. Measurements are of the tick's start, before the command of the tick acts.
struct AxisRecord {
  std::uint64_t tick = 0;
  std::int32_t axis = 0;
  io::DriveState state = io::DriveState::disabled;
  std::int64_t encoder_counts = 0;
  double scale_position_m = 0.0;
  double torque_command_Nm = 0.0;
  double torque_sensor_Nm = 0.0;
  double force_sensor_N = 0.0;
  double metered_power_W = 0.0;
  double lateness_us = 0.0;   ///< of the tick
  double work_us = 0.0;       ///< how long the tick before this one took
  double input_age_us = 0.0;  ///< of the request in force; negative: none
};

}  // namespace feedtwin::rt
