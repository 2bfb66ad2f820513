#pragma once
// Friction of the ball screw that changes along the stroke: lead deviation against preload, wear in mid-stroke, a screw that
// is out of line with its guide and so drags differently forth and back.
//
//   F_C and F_S of the ball screw times 1 + s u,   mu+ + e+ u,   mu- + e- u,   u = (x - x_c) / (L / 2)
//
// s = relative_slope_per_half_stroke, e+ and e- = viscous_slope_forth and _back_Ns_per_m, x_c = mid-stroke, L = stroke. The
// factor and what is left of mu never fall below a hundredth.

#include <algorithm>
#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/law_contact.h"

namespace feedtwin::plant::effects {

class PositionFriction final : public Effect {
 public:
  PositionFriction(const EffectContext& context, const EffectSetting& setting)
      : contact_(context.axis),
        slope_(setting.values[0]),
        viscous_slope_Ns_per_m_{setting.values[1], setting.values[2]},
        viscous_Ns_per_m_(context.axis.contact_of_laws().viscous_Ns_per_m),
        per_m_(2.0 / context.axis.axis.stroke_m),
        centre_m_(context.axis.axis.stroke_centre_m) {}

  void scale(const EffectMotion& m, FrictionScale<double>& scale) const noexcept override {
    contact_.sliding(scale) *= std::max(least, 1.0 + slope_ * half_strokes(m));
  }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const bool forth = m.velocity_m_per_s > 0.0;
    const double nominal = forth ? viscous_Ns_per_m_.pos : viscous_Ns_per_m_.neg;
    const double slope = forth ? viscous_slope_Ns_per_m_.pos : viscous_slope_Ns_per_m_.neg;
    const double more = std::max((least - 1.0) * nominal, slope * half_strokes(m));
    return {more * m.velocity_m_per_s, more};
  }

 private:
  static constexpr double least = 0.01;

  /// From mid-stroke, in the middle of the step.
  [[nodiscard]] double half_strokes(const EffectMotion& m) const noexcept {
    return per_m_ * (m.position_m + 0.5 * m.velocity_m_per_s * m.h_s - centre_m_);
  }

  LawContact contact_;
  double slope_;
  Directional viscous_slope_Ns_per_m_, viscous_Ns_per_m_;
  double per_m_, centre_m_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array position_friction_parameters{
    EffectParameter{"relative_slope_per_half_stroke", "1", -3.0, 3.0, {}, 0.0, "change from mid-stroke to the upper end over the nominal; positive: more friction at higher positions"},
    EffectParameter{"viscous_slope_forth_Ns_per_m", "N s/m", -100000.0, 100000.0, 0.0, 0.0, "change of mu+ from mid-stroke to the upper end"},
    EffectParameter{"viscous_slope_back_Ns_per_m", "N s/m", -100000.0, 100000.0, 0.0, 0.0, "change of mu- from mid-stroke to the upper end"},
};
// clang-format on

inline constexpr EffectEntry position_friction{
    .id = "position_friction",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::alters_friction,
    .meaning = "friction of the ball screw rises along the stroke",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "cable_spring local_friction thermal_friction",
    .exciting_move = "slow moves over the whole stroke, both directions",
    .parameters = position_friction_parameters,
    .make = make_effect<PositionFriction>,
    .hooks = hooks_of<PositionFriction>(),
    .even_in_motion = true,
    .of_contact = true,
};

}  // namespace feedtwin::plant::effects
