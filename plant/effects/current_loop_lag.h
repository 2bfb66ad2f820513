#pragma once
// The drive's current loop follows the command as a first-order lag.
//
//   T dT_m/dt = T_cmd - T_m
//
// T = time_constant_s. With the command held for a tick the solution is exact; the tick is driven by its mean, and each
// sub-step by what its own mean differs from that.

#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class CurrentLoopLag final : public Effect {
 public:
  CurrentLoopLag(const EffectContext& context, const EffectSetting& setting)
      : transmission_rad_per_m_(context.model.transmission_rad_per_m), time_constant_s_(setting.values[0]) {}

  void reset(double /*position_m*/) noexcept override { start_Nm_ = end_Nm_ = command_Nm_ = tick_mean_Nm_ = 0.0; }

  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& start) const noexcept override {
    return time_constant_s_ == 0.0 ? torque_Nm : mean_Nm(torque_Nm, end_Nm_, 0.0, start.span_s);
  }
  void take_torque(double torque_Nm, const TickStart& start) noexcept override {
    if (time_constant_s_ == 0.0) return;
    start_Nm_ = end_Nm_;
    command_Nm_ = torque_Nm;
    tick_mean_Nm_ = mean_Nm(command_Nm_, start_Nm_, 0.0, start.tick_s);
    end_Nm_ = command_Nm_ + (start_Nm_ - command_Nm_) * std::exp(-start.tick_s / time_constant_s_);
  }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    if (time_constant_s_ == 0.0) return {};
    return {transmission_rad_per_m_ * (tick_mean_Nm_ - mean_Nm(command_Nm_, start_Nm_, m.tick_phase_s, m.h_s)), 0.0};
  }

 private:
  /// Mean torque from `from_s` after the start of a tick, over h.
  [[nodiscard]] double mean_Nm(double command_Nm, double start_Nm, double from_s, double h_s) const noexcept {
    const double y = h_s / time_constant_s_;
    const double left = std::exp(-from_s / time_constant_s_) * (y > 1e-6 ? -std::expm1(-y) / y : 1.0 - 0.5 * y);
    return command_Nm + (start_Nm - command_Nm) * left;
  }

  double transmission_rad_per_m_, time_constant_s_;
  double start_Nm_ = 0.0, end_Nm_ = 0.0, command_Nm_ = 0.0, tick_mean_Nm_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array current_loop_lag_parameters{
    EffectParameter{"time_constant_s", "s", 0.0, 0.1, {}, 0.0, "time after which 63 % of a step is reached"},
};
// clang-format on

inline constexpr EffectEntry current_loop_lag{
    .id = "current_loop_lag",
    .component = EffectComponent::drive,
    .work = EffectWork::motor_torque,
    .meaning = "the motor's torque follows the command late, as a first-order lag",
    .channels = "torque_cmd_Nm position_m power_W",
    .confused_with = "input_delay channel_skew frictional_lag payload",
    .exciting_move = "strong changes of acceleration: jerk",
    .parameters = current_loop_lag_parameters,
    .make = make_effect<CurrentLoopLag>,
    .hooks = hooks_of<CurrentLoopLag>(),
};

}  // namespace feedtwin::plant::effects
