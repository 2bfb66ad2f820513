#pragma once
// The torque command takes effect late.
//
//   T_m(t) = T_cmd(t - D)
//
// D = delay_s. With the command held for a tick a broken number of ticks switches within one: the tick is driven by its
// mean, and each sub-step by what its own mean differs from that. A delay beyond the last 200 ticks counts as 200 ticks.

#include <algorithm>
#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/past.h"

namespace feedtwin::plant::effects {

class InputDelay final : public Effect {
 public:
  InputDelay(const EffectContext& context, const EffectSetting& setting)
      : transmission_rad_per_m_(context.model.transmission_rad_per_m), delay_s_(setting.values[0]) {}

  void reset(double /*position_m*/) noexcept override {
    past_ = {};
    early_Nm_ = late_Nm_ = mean_Nm_ = switch_s_ = 0.0;
  }

  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& start) noexcept override {
    past_.push(torque_Nm);
    const double ticks = std::min(delay_s_ / start.tick_s, past_.longest - 1.0);
    const int whole = static_cast<int>(ticks);
    const double broken = ticks - whole;
    late_Nm_ = past_.ago(whole);
    early_Nm_ = broken > 0.0 ? past_.ago(whole + 1) : late_Nm_;
    switch_s_ = broken * start.tick_s;
    mean_Nm_ = late_Nm_ + broken * (early_Nm_ - late_Nm_);
    return mean_Nm_;
  }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double early = std::clamp((switch_s_ - m.tick_phase_s) / m.h_s, 0.0, 1.0);
    return {transmission_rad_per_m_ * (mean_Nm_ - (late_Nm_ + early * (early_Nm_ - late_Nm_))), 0.0};
  }

 private:
  double transmission_rad_per_m_, delay_s_;
  Past past_;
  double early_Nm_ = 0.0, late_Nm_ = 0.0, mean_Nm_ = 0.0, switch_s_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array input_delay_parameters{
    EffectParameter{"delay_s", "s", 0.0, 0.05, {}, 0.0, "time from command to torque"},
};
// clang-format on

inline constexpr EffectEntry input_delay{
    .id = "input_delay",
    .component = EffectComponent::drive,
    .work = EffectWork::motor_torque,
    .meaning = "the torque command takes effect late",
    .channels = "torque_cmd_Nm position_m power_W",
    .confused_with = "current_loop_lag channel_skew frictional_lag",
    .exciting_move = "strong changes of acceleration: jerk",
    .parameters = input_delay_parameters,
    .make = make_effect<InputDelay>,
    .hooks = hooks_of<InputDelay>(),
};

}  // namespace feedtwin::plant::effects
