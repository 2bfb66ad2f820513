#include "tools/identify/stages/component_forces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/identify/zero_phase_filter.h"

namespace feedtwin::tools {

ComponentForces component_forces(const Recording& recording, double lead_m, double cutoff_Hz) {
  const double k = 2.0 * std::numbers::pi / lead_m, sample_s = recording.sample_s;
  const double cutoff = std::min(0.9, 2.0 * cutoff_Hz * sample_s);  // of Nyquist
  ComponentForces forces;
  forces.sample_s = sample_s;
  forces.position_m = filter_both_ways(butterworth(4, cutoff), recording.at(channel::position_m));
  forces.velocity_m_per_s = central_difference(forces.position_m, sample_s);
  const std::size_t n = forces.position_m.size();
  const auto& v = forces.velocity_m_per_s;
  forces.acceleration_m_per_s2.resize(n);
  // a sensor's row already feels the command that is held from it on: half a sample after the row
  for (std::size_t i = 0; i + 1 < n; ++i) forces.acceleration_m_per_s2[i] = (v[i + 1] - v[i]) / sample_s;
  forces.since_reversal_m.resize(n);
  double travelled_m = 0.0;
  for (std::size_t i = 1; i < n; ++i) {
    travelled_m = v[i] * v[i - 1] <= 0.0 ? 0.0 : travelled_m + std::abs(forces.position_m[i] - forces.position_m[i - 1]);
    forces.since_reversal_m[i] = travelled_m;
  }
  const auto command = recording.at(channel::torque_cmd_Nm), torque = recording.at(channel::torque_sensor_Nm);
  const auto force = recording.at(channel::force_sensor_N);
  for (std::size_t i = 0; i < n; ++i) forces.total_N.push_back(k * command[i]);
  for (std::size_t i = 0; i < torque.size(); ++i) forces.motor_N.push_back(k * (command[i] - torque[i]));
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (!torque.empty()) forces.screw_N.push_back(k * torque[i] - force[i]);
    forces.guide_N.push_back(force[i]);
  }
  return forces;
}

}  // namespace feedtwin::tools
