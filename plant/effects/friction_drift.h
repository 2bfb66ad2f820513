#pragma once
// Friction that changes with time alone: running-in, or lubrication that redistributes within a session.
//
//   F_C, F_S and mu of the ball screw times 1 + c + (b - c) exp(-t / T)
//
// c = relative_change, T = time_constant_s, b = initial_change, t since the run began. b is what grease or wear did between
// sessions; T at its lowest is a step between them too.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/law_contact.h"
#include "plant/effects/saturating_change.h"

namespace feedtwin::plant::effects {

class FrictionDrift final : public Effect {
 public:
  FrictionDrift(const EffectContext& context, const EffectSetting& setting)
      : contact_(context.axis), change_(setting.values[0], setting.values[1], setting.values[2]) {}

  void tick(const TickStart& start) noexcept override { factor_ = change_.factor(start.time_s); }

  void scale(const EffectMotion& /*motion*/, FrictionScale<double>& scale) const noexcept override {
    contact_.sliding(scale) *= factor_;
    contact_.viscous(scale) *= factor_;
  }

 private:
  LawContact contact_;
  SaturatingChange change_;
  double factor_ = 1.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array friction_drift_parameters{
    EffectParameter{"relative_change", "1", -0.9, 5.0, {}, 0.0, "change of the friction after a long time, over the nominal; positive: more friction"},
    EffectParameter{"time_constant_s", "s", 0.001, 1000000.0, {}, {}, "time after which 63 % of the change is reached"},
    EffectParameter{"initial_change", "1", -0.9, 5.0, 0.0, {}, "change that a run begins with"},
};
// clang-format on

inline constexpr EffectEntry friction_drift{
    .id = "friction_drift",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "friction of the ball screw changes with time, whatever the motion",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "thermal_friction torque_gain_error",
    .exciting_move = "the same move at the start, the middle and the end of a long session with rests",
    .parameters = friction_drift_parameters,
    .make = make_effect<FrictionDrift>,
    .hooks = hooks_of<FrictionDrift>(),
    .of_contact = true,
};

}  // namespace feedtwin::plant::effects
