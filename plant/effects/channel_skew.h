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
  void show(AxisSignals& signals) noexcept override {
    late(0, delay_s_[0], signals.scale_position_m);
    late(3, delay_s_[3], signals.metered_power_W);
    late(4, delay_s_[3], signals.power_W);
  }
  void show_forces(ForceSignals& forces) const noexcept override {
    forces = {ago(1, delay_s_[1], forces.torque_sensor_Nm), ago(2, delay_s_[2], forces.force_sensor_N)};
  }
  void take_forces(const ForceSignals& forces) noexcept override {
    past_[1].push(forces.torque_sensor_Nm);
    past_[2].push(forces.force_sensor_N);
  }

 private:
  [[nodiscard]] double ago(std::size_t channel, double delay_s, double newest) const noexcept {
    const double ticks = std::min(delay_s / tick_s_, static_cast<double>(Past::longest));
    const int whole = static_cast<int>(ticks);
    const double later = whole == 0 ? newest : past_[channel].ago(whole - 1);
    return later + (ticks - whole) * (past_[channel].ago(whole) - later);
  }
  void late(std::size_t channel, double delay_s, double& value) noexcept {
    const double shown = ago(channel, delay_s, value);
    past_[channel].push(value);
    value = shown;
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
