#pragma once
// What a controller is asked to follow at an instant.

namespace feedtwin::controllers {

struct Reference {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double acceleration_m_per_s2 = 0.0;
  double force_N = 0.0;  ///< to be fed forward as it is, at the table
};

}  // namespace feedtwin::controllers
