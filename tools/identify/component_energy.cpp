#include "tools/identify/component_energy.h"

#include <numbers>

namespace feedtwin::tools {

ComponentEnergy component_energy(const SensedRun& run) {
  const double k = 2.0 * std::numbers::pi / run.lead_m;
  double command_J = 0.0, sensor_J = 0.0, guide_J = 0.0, electric_J = 0.0;
  for (std::size_t i = 0; i + 1 < run.position_m.size(); ++i) {
    const double travel_m = run.position_m[i + 1] - run.position_m[i];
    command_J += k * run.torque_Nm[i] * travel_m;  // held over the tick
    // sensors are instants: the mean of a tick's two ends
    if (!run.torque_sensor_Nm.empty())
      sensor_J += k * 0.5 * (run.torque_sensor_Nm[i] + run.torque_sensor_Nm[i + 1]) * travel_m;
    if (!run.force_sensor_N.empty()) guide_J += 0.5 * (run.force_sensor_N[i] + run.force_sensor_N[i + 1]) * travel_m;
  }
  for (const double power : run.power_W) electric_J += power * run.sample_s;
  ComponentEnergy energy;
  energy.input_work_J = command_J;
  if (!run.power_W.empty()) energy.motor_electrical_J = electric_J - command_J;
  if (!run.torque_sensor_Nm.empty()) energy.motor_mechanical_J = command_J - sensor_J;
  if (!run.force_sensor_N.empty()) energy.guide_J = guide_J;
  if (!run.torque_sensor_Nm.empty() && !run.force_sensor_N.empty()) energy.ball_screw_J = sensor_J - guide_J;
  if (!run.power_W.empty()) energy.total_J = electric_J;
  return energy;
}

}  // namespace feedtwin::tools
