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
    now_ = {};
  }

  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& start) const noexcept override {
    return switching(torque_Nm, start.tick_s).mean_Nm(0.0, start.span_s);
  }
  void take_torque(double torque_Nm, const TickStart& start) noexcept override {
    now_ = switching(torque_Nm, start.tick_s);
    tick_mean_Nm_ = now_.mean_Nm(0.0, start.tick_s);
    past_.push(torque_Nm);
  }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    return {transmission_rad_per_m_ * (tick_mean_Nm_ - now_.mean_Nm(m.tick_phase_s, m.h_s)), 0.0};
  }

 private:
  /// A tick's torque: one until the switch, the other after it.
  struct Switching {
    double early_Nm = 0.0, late_Nm = 0.0, switch_s = 0.0;
    [[nodiscard]] double mean_Nm(double from_s, double h_s) const noexcept {
      return late_Nm + std::clamp((switch_s - from_s) / h_s, 0.0, 1.0) * (early_Nm - late_Nm);
    }
  };
  [[nodiscard]] Switching switching(double newest_Nm, double tick_s) const noexcept {
    const double ticks = std::min(delay_s_ / tick_s, static_cast<double>(Past::longest));
    const int whole = static_cast<int>(ticks);
    return {past_.ago(whole), whole == 0 ? newest_Nm : past_.ago(whole - 1), (ticks - whole) * tick_s};
  }

  double transmission_rad_per_m_, delay_s_;
  Past past_;
  Switching now_;
  double tick_mean_Nm_ = 0.0;
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
