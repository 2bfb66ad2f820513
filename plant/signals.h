#pragma once
// What passes between a controller and the plant in one tick. SI units; the unit is in the name.

#include <cstdint>
#include <limits>

namespace feedtwin::plant {

/// Into the plant, held for one tick.
struct AxisCommand {
  double torque_Nm = 0.0;        ///< torque command to the drive
  double cutting_force_N = 0.0;  ///< against positive motion of the table
  /// Velocity that the drive is told to reach; not a number: it is told a torque alone.
  double setpoint_m_per_s = std::numeric_limits<double>::quiet_NaN();
};

/// Out of the plant at the end of a tick.
struct AxisSignals {
  std::int64_t encoder_counts = 0;  ///< motor encoder, four counts a line
  bool index_passed = false;        ///< the encoder's index was crossed within the tick
  double position_m = 0.0;          ///< motor shaft's angle as table travel, unquantised
  double scale_position_m = 0.0;    ///< table as a linear scale on it shows, unquantised; the same without effects
  double velocity_m_per_s = 0.0;
  double torque_Nm = 0.0;        ///< motor torque after the drive's limit
  double power_W = 0.0;          ///< drive input, mean over the tick
  double metered_power_W = 0.0;  ///< the same as the power meter shows it
};

/// The source's force sensors (section 3.1), at the end of a tick.
struct ForceSignals {
  double torque_sensor_Nm = 0.0;  ///< T_I, between motor and screw
  double force_sensor_N = 0.0;    ///< F_I, between nut and table
};

}  // namespace feedtwin::plant
