#include "tools/identify/channel_residuals.h"

#include <algorithm>
#include <numbers>

namespace feedtwin::tools {
namespace {

std::vector<double> slip_residual(const Recording& recording, const Simulated& simulated) {
  const auto scale = recording.at(channel::scale_position_m), motor = recording.at(channel::position_m);
  std::vector<double> residual(scale.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    residual[i] = simulated.scale_position_m[i] - simulated.position_m[i] - (scale[i] - motor[i]);
    mean += residual[i] / static_cast<double>(residual.size());
  }
  for (double& value : residual) value -= mean;
  return residual;
}

}  // namespace

std::vector<double> with_recorded_work(const ClosedLoopRun& run, const Simulated& simulated) {
  const auto view = run.view();
  const double limit_Nm = view.torque_limit_Nm, to_power = 2.0 * std::numbers::pi / run.nominal().axis.lead_m / view.tick_s;
  std::vector<double> power_W = simulated.power_W;
  for (std::size_t i = 0; i + 1 < view.samples; ++i) {
    const auto work = [limit_Nm](double torque_Nm, double travel_m) {
      return std::clamp(torque_Nm, -limit_Nm, limit_Nm) * travel_m;
    };
    power_W[i] += to_power * (work(view.torque_Nm[i], view.position_m[i + 1] - view.position_m[i]) -
                              work(simulated.torque_Nm[i], simulated.position_m[i + 1] - simulated.position_m[i]));
  }
  return power_W;
}

lanes::Wanted wanted_for(const Recording& recording) {
  return {.torque = true,
          .position = true,
          .torque_sensor = recording.has(channel::torque_sensor_Nm),
          .force_sensor = recording.has(channel::force_sensor_N),
          .power = recording.has(channel::power_W)};
}

std::span<const double> simulated_channel(const Simulated& simulated, std::string_view name) {
  if (name == channel::torque_cmd_Nm) return simulated.torque_Nm;
  if (name == channel::position_m) return simulated.position_m;
  if (name == channel::torque_sensor_Nm) return simulated.torque_sensor_Nm;
  if (name == channel::force_sensor_N) return simulated.force_sensor_N;
  if (name == channel::power_W) return simulated.power_W;
  if (name == channel::scale_position_m) return simulated.scale_position_m;
  return {};
}

std::array<std::vector<double>, fitted_channels.size()> channel_residuals(const Recording& recording,
                                                                          const MeteredPower& meter,
                                                                          const Simulated& simulated) {
  std::array<std::vector<double>, fitted_channels.size()> all;
  for (std::size_t c = 0; c < fitted_channels.size(); ++c) {
    const auto recorded = recording.at(fitted_channels[c]);
    const auto model = simulated_channel(simulated, fitted_channels[c]);
    if (recorded.empty() || model.empty()) continue;
    if (fitted_channels[c] == channel::scale_position_m) {
      all[c] = slip_residual(recording, simulated);
    } else if (fitted_channels[c] == channel::power_W) {
      const auto shown = as_metered(model, meter);
      for (const std::size_t row : meter.rows) all[c].push_back(shown[row] - recorded[row]);
    } else {
      all[c].resize(recorded.size());
      for (std::size_t i = 0; i < recorded.size(); ++i) all[c][i] = model[i] - recorded[i];
    }
  }
  return all;
}

}  // namespace feedtwin::tools
