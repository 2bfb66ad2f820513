#pragma once
// What a testbed's sensors say each component resisted with, at every row of a recording (the forces in Eqs. 12-14):
//
//   motor  k (T_C - T_I) = J_M k^2 a + B_M k^2 v + F_M
//   screw  k T_I - F_I   = J_B k^2 a + F_B
//   guide  F_I           = M_L a + F_L,                       k = 2 pi / p_b

#include <vector>

#include "tools/recording/recording.h"

namespace feedtwin::tools {

/// At the rows' instants, each as long as the recording. A component without its sensors is empty.
struct ComponentForces {
  double sample_s = 0.0;
  std::vector<double> position_m, velocity_m_per_s;
  std::vector<double> acceleration_m_per_s2;  ///< with the row's command acting, as the sensors have it
  std::vector<double> since_reversal_m;       ///< travelled since the direction last changed
  std::vector<double> motor_N, screw_N, guide_N;
  std::vector<double> total_N;  ///< k T_C
};

/// @param cutoff_Hz of the zero-phase low-pass that the encoder's grid is taken out by
[[nodiscard]] ComponentForces component_forces(const Recording& recording, double lead_m, double cutoff_Hz = 100.0);

}  // namespace feedtwin::tools
