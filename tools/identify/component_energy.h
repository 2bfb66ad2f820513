#pragma once
// Energy by component from a testbed's sensors, Eqs. 11-14: what the paper's Table 4 holds.
//
//   P_M1 = P_I - k x' T_C,  P_M2 = k x' (T_C - T_I),  P_B = x' (k T_I - F_I),  P_L = x' F_I,   k = 2 pi / p_b

#include <optional>
#include <span>

namespace feedtwin::tools {

/// A run's channels; what is missing is empty, and with it the entries that need it.
struct SensedRun {
  std::span<const double> torque_Nm, position_m, torque_sensor_Nm, force_sensor_N, power_W;
  double lead_m, sample_s;
};

struct ComponentEnergy {
  std::optional<double> motor_electrical_J, motor_mechanical_J, ball_screw_J, guide_J, total_J;
  double input_work_J = 0.0;  ///< of the torque command
};

[[nodiscard]] ComponentEnergy component_energy(const SensedRun& run);

}  // namespace feedtwin::tools
