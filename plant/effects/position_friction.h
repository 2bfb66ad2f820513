#pragma once
// Friction of the ball screw that changes along the stroke: lead deviation against preload, wear in mid-stroke.
//
//   F_C and F_S of the ball screw times 1 + s (x - x_c) / (L / 2)
//
// s = relative_slope_per_half_stroke, x_c = mid-stroke, L = stroke. The factor never falls below a hundredth.

#include <algorithm>
#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class PositionFriction final : public Effect {
 public:
  PositionFriction(const EffectContext& context, const EffectSetting& setting)
      : slope_per_m_(2.0 * setting.values[0] / context.axis.axis.stroke_m), centre_m_(context.axis.axis.stroke_centre_m) {}

  void scale(const EffectMotion& m, FrictionScale<double>& scale) const noexcept override {
    const double middle_m = m.position_m + 0.5 * m.velocity_m_per_s * m.h_s;
    scale.screw_sliding *= std::max(0.01, 1.0 + slope_per_m_ * (middle_m - centre_m_));
  }

 private:
  double slope_per_m_, centre_m_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array position_friction_parameters{
    EffectParameter{"relative_slope_per_half_stroke", "1", -3.0, 3.0, {}, 0.0, "change from mid-stroke to the upper end over the nominal; positive: more friction at higher positions"},
};
// clang-format on

inline constexpr EffectEntry position_friction{
    .id = "position_friction",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "Coulomb friction of the ball screw rises along the stroke",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "cable_spring local_friction thermal_friction",
    .exciting_move = "slow moves over the whole stroke, both directions",
    .parameters = position_friction_parameters,
    .make = make_effect<PositionFriction>,
    .hooks = hooks_of<PositionFriction>(),
};

}  // namespace feedtwin::plant::effects
