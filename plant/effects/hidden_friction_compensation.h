#pragma once
// The drive compensates friction behind the command's back.
//
//   T_m = T_cmd + T_c tanh(v / v_0)
//
// T_c = torque_Nm, v_0 = speed_m_per_s, v the velocity that the drive is told to reach, as drives compensate: what follows
// the measured one feeds itself at rest. Where the drive is told a torque alone v is the axis's, at the start of the tick.
// What replays a recording (tools/identify/closed_loop.h) sets v from the recorded reference, or where there is none, or
// of_motion says so, from the recorded motion; ahead of that by lead_s, as x + T dx/dt is of a position loop without
// feed-forward. Here v is a set point already.

#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class HiddenFrictionCompensation final : public Effect {
 public:
  HiddenFrictionCompensation(const EffectContext& /*context*/, const EffectSetting& setting)
      : torque_Nm_(setting.values[0]), per_speed_s_per_m_(1.0 / setting.values[1]) {}
  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& start) const noexcept override {
    return torque_Nm + torque_Nm_ * std::tanh(start.setpoint_m_per_s * per_speed_s_per_m_);
  }

 private:
  double torque_Nm_, per_speed_s_per_m_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array hidden_friction_compensation_parameters{
    EffectParameter{"torque_Nm", "N m", -10.0, 10.0, {}, 0.0, "added while moving forth; negative: friction looks larger"},
    EffectParameter{"speed_m_per_s", "m/s", 1e-05, 1.0, 0.001, {}, "speed at which 76 % of it is added"},
    EffectParameter{"lead_s", "s", -0.1, 0.2, 0.0, {}, "how far a recording's set point ran ahead of what it shows of it"},
    EffectParameter{"of_motion", "1", 0.0, 1.0, 0.0, {}, "1: of a recording the motion tells v, whatever reference it has"},
};
// clang-format on

inline constexpr EffectEntry hidden_friction_compensation{
    .id = "hidden_friction_compensation",
    .component = EffectComponent::set_up,
    .work = EffectWork::none,
    .meaning = "the drive adds torque with the sign of the velocity, so that friction looks smaller than it is",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "torque_gain_error direction_dependent_friction friction_drift",
    .exciting_move = "slow reversals with a torque sensor",
    .parameters = hidden_friction_compensation_parameters,
    .make = make_effect<HiddenFrictionCompensation>,
    .hooks = hooks_of<HiddenFrictionCompensation>(),
};

}  // namespace feedtwin::plant::effects
