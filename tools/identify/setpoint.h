#pragma once
// What the drive of a recording was told to reach.

#include <span>
#include <vector>

#include "plant/parameters.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools {

/// What it is told from, see plant/effects/hidden_friction_compensation.h.
struct SetpointSource {
  double lead_s = 0.0;
  bool of_motion = false;
};
[[nodiscard]] SetpointSource setpoint_source(const plant::AxisParameters& axis);

/// A velocity row by row, and its slope over some 20 ms: the encoder's grid must not lead.
struct Setpoint {
  std::vector<double> velocity_m_per_s, slope_m_per_s2;

  [[nodiscard]] double m_per_s(std::size_t row, double lead_s) const noexcept {
    return velocity_m_per_s[row] + lead_s * slope_m_per_s2[row];
  }
};

struct Setpoints {
  Setpoint of_motion;     ///< from the rows before and after; over some more where that is no more than the encoder's grid
  Setpoint of_reference;  ///< empty where none was recorded

  [[nodiscard]] const Setpoint& by(bool motion) const {
    return motion || of_reference.velocity_m_per_s.empty() ? of_motion : of_reference;
  }
};

/// @param count_m the encoder's
[[nodiscard]] Setpoints setpoints_of(const Recording& recording, double count_m);

}  // namespace feedtwin::tools
