#include "tests/support/made_case.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "plant/effects/registry.h"
#include "plant/feed_axis.h"
#include "tools/config/input_error.h"
#include "tools/recording/power_meter.h"

namespace feedtwin::tests {

tools::Recording make_recording(const plant::AxisParameters& parameters, const MadeRun& run,
                                const controllers::CascadeGains& gains) {
  namespace channel = tools::channel;
  const auto kinds = controllers::motion_kinds();
  const auto kind = std::ranges::find(kinds, run.motion, &controllers::MotionKind::name);
  const auto motion = kind->make(run.settings);
  plant::FeedAxis axis(parameters, run.resolution);
  const double start_m = motion->at(0.0).position_m;
  axis.place(start_m);
  controllers::Cascade cascade(gains);
  cascade.reset(start_m);
  std::mt19937 random(run.seed);
  std::normal_distribution<double> unit;
  tools::Recording recording;
  recording.file = run.motion + ".csv";
  recording.is_text = true;
  recording.sample_s = 1e-3;
  const auto push = [&recording](std::string_view name, double value) {
    recording.channels[std::string(name)].push_back(value);
  };
  const auto on_grid = [](double value, double grid) { return grid > 0.0 ? grid * std::round(value / grid) : value; };
  double metered_W = 0.0, read_W = 0.0, acting_Nm = 0.0;
  const auto rows = static_cast<int>(run.duration_s * 1e3);
  for (int i = 0; i < rows; ++i) {
    const double time_s = i * 1e-3;
    const auto& signals = axis.signals();
    const double position_m = run.quantised ? axis.encoder().position_m(signals.encoder_counts) : signals.position_m;
    const auto reference = motion->at(time_s);
    const double torque_Nm = cascade.torque_Nm(reference, position_m, 1e-3);
    push(channel::time_s, time_s);
    push(channel::torque_cmd_Nm, torque_Nm);
    push(channel::position_m, position_m);
    push(channel::reference_m, reference.position_m);
    if (run.sensors) {
      const double scale_m = run.scale_at_table ? signals.scale_position_m : position_m;
      push(channel::scale_position_m, run.quantised ? std::round(scale_m * 1e8) * 1e-8 : scale_m);
      const auto sensors = axis.force_sensors({.torque_Nm = run.forces_before_command ? acting_Nm : torque_Nm});
      acting_Nm = torque_Nm;
      push(channel::torque_sensor_Nm,
           on_grid(sensors.torque_sensor_Nm + run.torque_noise_Nm * unit(random), run.torque_grid_Nm));
      push(channel::force_sensor_N, on_grid(sensors.force_sensor_N + run.force_noise_N * unit(random), run.force_grid_N));
    }
    axis.step({.torque_Nm = torque_Nm}, 1e-3);
    if (run.sensors) {
      if (axis.signals().metered_power_W != metered_W) {  // a new reading
        metered_W = axis.signals().metered_power_W;
        read_W = on_grid(metered_W + run.power_noise_W * unit(random), run.power_grid_W);
      }
      push(channel::power_W, read_W);
    }
  }
  return recording;
}

void compute_power_from_command(std::vector<tools::Recording>& runs, const plant::AxisParameters& axis) {
  namespace channel = tools::channel;
  constexpr std::size_t window = 100;
  const double rad_per_m = 2.0 * std::numbers::pi / axis.axis.lead_m;
  for (auto& run : runs) {
    const auto command_Nm = run.at(channel::torque_cmd_Nm), position_m = run.at(channel::position_m);
    auto& power_W = run.channels.at(std::string(channel::power_W));
    std::vector<double> instants(power_W.size(), 0.0);
    for (std::size_t k = 1; k + 1 < instants.size(); ++k) {
      const double v = (position_m[k + 1] - position_m[k - 1]) / (2.0 * run.sample_s);
      const auto own = [v](const auto& by_direction) { return v > 0.0 ? by_direction.pos : by_direction.neg; };
      instants[k] = axis.motor.electrical_idle_W + own(axis.motor.electrical_linear_Ws_per_m) * std::abs(v) +
                    own(axis.motor.electrical_quadratic_Ws2_per_m2) * v * v + command_Nm[k] * rad_per_m * v;
    }
    instants.front() = instants[1], instants.back() = instants[instants.size() - 2];
    power_W = tools::as_metered(instants, tools::metered_rows(power_W, window));
  }
}

plant::EffectSetting effect(std::string_view id, std::initializer_list<std::pair<std::string_view, double>> values) {
  const auto* entry = plant::find_effect(id);
  auto made = plant::preset_of(*entry);
  for (const auto& [name, value] : values) *plant::value_in(made, *entry, name) = value;
  return made;
}

tools::Case short_case(const plant::AxisParameters& truth, const plant::AxisParameters& nominal) {
  tools::Case data;
  data.axis = nominal;
  const auto run = [&truth](const char* motion, double speed, double amplitude, unsigned seed) {
    MadeRun made{.motion = motion, .duration_s = 3.0, .sensors = false, .seed = seed};
    made.settings.speed_m_per_s = speed;
    made.settings.amplitude_m = amplitude;
    return make_recording(truth, made);
  };
  data.fit = {run("sine", 0.08, 0.02, 1), run("s_curve", 0.05, 0.015, 2)};
  data.holdout = {run("triangle", 0.03, 0.012, 3)};
  return data;
}

ScratchFolder::ScratchFolder(std::string_view name)
    : path_(std::filesystem::path(testing::TempDir()) /
            ("feedtwin-" + std::string(name) + "-" + std::to_string(::getpid()))) {
  std::filesystem::create_directories(path_);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string complaint_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const tools::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace feedtwin::tests
