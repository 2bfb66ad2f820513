#include "tests/support/testbed.h"

#include <random>

#include "plant/parameter_table.h"
#include "tests/support/random_axis.h"

namespace feedtwin::tests {

std::vector<tools::Recording> testbed_runs(const plant::AxisParameters& axis, Sensors sensors, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> centre_m(-0.01, 0.01);
  MadeRun run;
  run.resolution = plant::one_count;
  run.torque_noise_Nm = sensors == Sensors::paper ? 5e-4 : 6e-4;
  run.force_noise_N = 0.06;
  if (sensors == Sensors::paper) {
    run.torque_grid_Nm = 10.0 / 65536.0;
    run.force_grid_N = 1000.0 / 65536.0;
    run.power_noise_W = 3e-4;
    run.power_grid_W = 1e-3;
  }
  std::vector<tools::Recording> runs;
  const auto record = [&](const char* motion, double amplitude_m, double speed_m_per_s, double duration_s) {
    run.motion = motion;
    run.settings.centre_m = centre_m(random);
    run.settings.amplitude_m = amplitude_m;
    run.settings.speed_m_per_s = speed_m_per_s;
    run.settings.slowest_m_per_s = 3e-4;
    run.duration_s = duration_s;
    run.seed = static_cast<unsigned>(random());
    runs.push_back(make_recording(axis, run));
    runs.back().file = std::string(motion) + std::to_string(runs.size()) + ".csv";
  };
  record("stair", 0.03, 0.12, 10.0);
  record("sine", 2e-5, 2e-3, 6.0);
  record("sine", 6e-5, 6e-3, 4.0);
  record("sine", 0.02, 0.06, 4.0);
  return runs;
}

tools::Case testbed_case(const plant::AxisParameters& axis, Sensors sensors, unsigned seed, double off) {
  std::mt19937_64 random(seed + 1000003);
  std::uniform_real_distribution<double> factor(1.0 - off, 1.0 + off);
  tools::Case made;
  made.fit = testbed_runs(axis, sensors, seed);
  made.axis = axis;
  for (const auto& entry : plant::parameter_table()) {
    const bool kept =
        entry.key.starts_with("axis.") || entry.key.starts_with("power.") || entry.key == "motor.rated_torque_Nm";
    if (!kept) entry.in(made.axis) *= factor(random);
  }
  make_admissible(made.axis);
  return made;
}

}  // namespace feedtwin::tests
