#pragma once
// Experiments that a user can make, as the plant can make them beforehand: a motion scaled to the axis and to what the
// recordings cover, with something changed beside it where that is what tells.

#include <span>
#include <string>
#include <string_view>

#include "controllers/motion.h"
#include "plant/parameters.h"

namespace feedtwin::tools::diagnosis {

/// Channels that a recording lacks and an experiment may add.
enum class Extra { nothing, torque_sensor, force_sensor, scale };

struct Move {
  std::string_view text;    ///< what the user is to do
  std::string_view motion;  ///< of controllers/motion.h
  double amplitude_in_half_strokes = 0.3;
  double speed_in_fastest = 1.0;              ///< of the recordings
  double acceleration_in_torque_limit = 0.3;  /// by the mass
  double jerk_m_per_s3 = 50.0, dwell_s = 0.2;
  double duration_s = 6.0;
  double more_on_table_kg = 0.0;
  bool process_runs = true;  ///< false: a move to ask only where a process is in question
  Extra extra = Extra::nothing;
};

/// Cheapest first.
[[nodiscard]] std::span<const Move> moves() noexcept;

/// @param fastest_m_per_s of the recordings
[[nodiscard]] controllers::MotionSettings settings_of(const Move& move, const plant::AxisParameters& axis,
                                                      double fastest_m_per_s);

}  // namespace feedtwin::tools::diagnosis
