#pragma once
// Simulated less recorded, channel by channel.

#include <array>
#include <string_view>
#include <vector>

#include "tools/identify/closed_loop.h"

namespace feedtwin::tools {

/// The channels that identification learns from, in this order.
inline constexpr std::array fitted_channels{channel::torque_cmd_Nm, channel::torque_sensor_Nm, channel::force_sensor_N,
                                            channel::power_W, channel::scale_position_m};

/// What a simulation has to give for this recording.
[[nodiscard]] lanes::Wanted wanted_for(const Recording& recording);

/// A channel as simulated; empty where it was not asked for.
[[nodiscard]] std::span<const double> simulated_channel(const Simulated& simulated, std::string_view name);

/// Drive input with the recorded mechanical work in place of the simulated one: the stand-in answers the encoder's grid
/// with torque, which at speed is more power than what the loss coefficients are to be told by.
[[nodiscard]] std::vector<double> with_recorded_work(const ClosedLoopRun& run, const Simulated& simulated);

/// Residuals of the fitted channels, empty where the recording or the simulation lacks one. Power: one residual for each
/// meter reading. Scale: what it shows beyond the motor encoder, without its mean, since where a ruler has its zero tells
/// nothing.
[[nodiscard]] std::array<std::vector<double>, fitted_channels.size()> channel_residuals(const Recording& recording,
                                                                                        const MeteredPower& meter,
                                                                                        const Simulated& simulated);

}  // namespace feedtwin::tools
