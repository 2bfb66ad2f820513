#pragma once
// Friction of the ball screw that goes up and down along the stroke: a raceway that was ground unevenly, wear where it works
// most, a screw that runs out of true with its nut. It repeats in both directions, with the sign of the velocity (effects of
// screw preload along the stroke: ISO 3408-3, variation of dynamic preload drag torque).
//
//   F_C and F_S of the ball screw times 1 + A sin(2 pi (x - x_c) / L + phi),   mu + A_v sin(2 pi (x - x_c) / L + phi_v)
//
// A = relative_amplitude, A_v = viscous_amplitude_Ns_per_m, L = period_m, phi = phase_rad, phi_v = viscous_phase_rad,
// x_c = mid-stroke. The factor and what is left of mu never fall below a hundredth.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plant/effects/entry.h"
#include "plant/effects/law_contact.h"

namespace feedtwin::plant::effects {

class PositionFrictionWave final : public Effect {
 public:
  PositionFrictionWave(const EffectContext& context, const EffectSetting& setting)
      : contact_(context.axis),
        amplitude_(setting.values[0]),
        rad_per_m_(2.0 * std::numbers::pi / setting.values[1]),
        phase_rad_(setting.values[2]),
        viscous_amplitude_Ns_per_m_(setting.values[3]),
        viscous_phase_rad_(setting.values[4]),
        viscous_Ns_per_m_(context.axis.contact_of_laws().viscous_Ns_per_m),
        centre_m_(context.axis.axis.stroke_centre_m) {}

  void scale(const EffectMotion& m, FrictionScale<double>& scale) const noexcept override {
    contact_.sliding(scale) *= std::max(least, 1.0 + amplitude_ * std::sin(angle_rad(m) + phase_rad_));
  }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    if (viscous_amplitude_Ns_per_m_ == 0.0) return {};
    const double nominal = m.velocity_m_per_s > 0.0 ? viscous_Ns_per_m_.pos : viscous_Ns_per_m_.neg;
    const double more =
        std::max((least - 1.0) * nominal, viscous_amplitude_Ns_per_m_ * std::sin(angle_rad(m) + viscous_phase_rad_));
    return {more * m.velocity_m_per_s, more};
  }

 private:
  static constexpr double least = 0.01;

  /// From mid-stroke, in the middle of the step.
  [[nodiscard]] double angle_rad(const EffectMotion& m) const noexcept {
    return rad_per_m_ * (m.position_m + 0.5 * m.velocity_m_per_s * m.h_s - centre_m_);
  }

  LawContact contact_;
  double amplitude_, rad_per_m_, phase_rad_, viscous_amplitude_Ns_per_m_, viscous_phase_rad_;
  Directional viscous_Ns_per_m_;
  double centre_m_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array position_friction_wave_parameters{
    EffectParameter{"relative_amplitude", "1", -2.0, 2.0, {}, 0.0, "of the wave, over the nominal sliding friction"},
    EffectParameter{"period_m", "m", 0.001, 100.0, {}, {}, "along the stroke"},
    EffectParameter{"phase_rad", "rad", -7.0, 7.0, 0.0, {}, "at mid-stroke"},
    EffectParameter{"viscous_amplitude_Ns_per_m", "N s/m", -100000.0, 100000.0, 0.0, 0.0, "of the wave in viscous friction"},
    EffectParameter{"viscous_phase_rad", "rad", -7.0, 7.0, 0.0, {}, "of that wave at mid-stroke"},
};
// clang-format on

inline constexpr EffectEntry position_friction_wave{
    .id = "position_friction_wave",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::alters_friction,
    .meaning = "friction of the ball screw goes up and down along the stroke",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "position_friction local_friction rev_ripple",
    .exciting_move = "slow moves over the whole stroke, both directions",
    .parameters = position_friction_wave_parameters,
    .make = make_effect<PositionFrictionWave>,
    .hooks = hooks_of<PositionFrictionWave>(),
    .even_in_motion = true,
    .of_contact = true,
};

}  // namespace feedtwin::plant::effects
