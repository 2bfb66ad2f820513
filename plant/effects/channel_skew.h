#pragma once
// Channels of a recording are not of the same instant: each comes late against the encoder.
//
//   shown(t) = true(t - D),   one delay for each channel, broken ticks on the line between two

#include <algorithm>
#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/past.h"

namespace feedtwin::plant::effects {

class ChannelSkew final : public Effect {
 public:
  ChannelSkew(const EffectContext& /*context*/, const EffectSetting& setting) {
    for (std::size_t i = 0; i < delay_s_.size(); ++i) delay_s_[i] = setting.values[i];
  }
  void reset(double position_m) noexcept override {
    for (auto& past : past_) past = {};
    past_[0].fill(position_m);
  }
  void tick(const TickStart& start) noexcept override { tick_s_ = start.tick_s; }
  void show(AxisSignals& signals, ForceSignals& forces) noexcept override {
    delay(0, delay_s_[0], signals.scale_position_m);
    delay(1, delay_s_[1], forces.torque_sensor_Nm);
    delay(2, delay_s_[2], forces.force_sensor_N);
    delay(3, delay_s_[3], signals.metered_power_W);
    delay(4, delay_s_[3], signals.power_W);
  }

 private:
  void delay(std::size_t channel, double delay_s, double& value) noexcept {
    past_[channel].push(value);
    const double ticks = std::min(delay_s / tick_s_, Past::longest - 1.0);
    const int whole = static_cast<int>(ticks);
    const double later = past_[channel].ago(whole);
    value = later + (ticks - whole) * (past_[channel].ago(whole + 1) - later);
  }

  std::array<double, 4> delay_s_{};
  std::array<Past, 5> past_;
  double tick_s_ = 1e-3;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array channel_skew_parameters{
    EffectParameter{"scale_delay_s", "s", 0.0, 0.05, 0.0, 0.0, "of the linear scale"},
    EffectParameter{"torque_sensor_delay_s", "s", 0.0, 0.05, 0.0, 0.0, "of the torque sensor"},
    EffectParameter{"force_sensor_delay_s", "s", 0.0, 0.05, 0.0, 0.0, "of the force sensor"},
    EffectParameter{"power_delay_s", "s", 0.0, 0.05, 0.0, 0.0, "of the power meter"},
};
// clang-format on

inline constexpr EffectEntry channel_skew{
    .id = "channel_skew",
    .component = EffectComponent::sensors,
    .work = EffectWork::none,
    .meaning = "channels are late against the encoder",
    .channels = "scale_position_m torque_sensor_Nm force_sensor_N power_W",
    .confused_with = "input_delay current_loop_lag frictional_lag",
    .exciting_move = "strong changes of acceleration: jerk",
    .parameters = channel_skew_parameters,
    .make = make_effect<ChannelSkew>,
    .hooks = hooks_of<ChannelSkew>(),
};

}  // namespace feedtwin::plant::effects
