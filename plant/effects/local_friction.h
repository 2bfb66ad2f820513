#pragma once
// A friction bump at one place of the guide or of the screw: a particle, a damaged track.
//
//   F_C and F_S there times 1 + H / F_C exp(-((x - x_0) / w)^2): sliding friction plus H
//
// H = height_N, x_0 = centre_m, w = half_width_m, of the screw where on_screw is 1. It never falls below a hundredth of the
// nominal friction.

#include <algorithm>
#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class LocalFriction final : public Effect {
 public:
  LocalFriction(const EffectContext& context, const EffectSetting& setting)
      : on_screw_(setting.values[3] > 0.5),
        coulomb_N_(on_screw_ ? context.axis.ball_screw.coulomb_N : context.axis.guide.coulomb_N),
        height_N_(setting.values[0]),
        centre_m_(setting.values[1]),
        per_width_(1.0 / setting.values[2]) {}

  void scale(const EffectMotion& m, FrictionScale<double>& scale) const noexcept override {
    const double u = (m.position_m + 0.5 * m.velocity_m_per_s * m.h_s - centre_m_) * per_width_;
    const double coulomb_N = m.sign > 0.0 ? coulomb_N_.pos : coulomb_N_.neg;
    (on_screw_ ? scale.screw_sliding : scale.guide_sliding) *=
        std::max(0.01, 1.0 + height_N_ / coulomb_N * std::exp(-u * u));
  }

 private:
  bool on_screw_;
  Directional coulomb_N_;
  double height_N_, centre_m_, per_width_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array local_friction_parameters{
    EffectParameter{"height_N", "N", -1000.0, 10000.0, {}, 0.0, "friction at the centre of the place beyond the nominal; positive: more friction"},
    EffectParameter{"centre_m", "m", -100.0, 100.0, {}, {}, "table position of the place"},
    EffectParameter{"half_width_m", "m", 1e-05, 10.0, {}, {}, "distance from the centre at which 37 % of the height is left"},
    EffectParameter{"on_screw", "1", 0.0, 1.0, 0.0, {}, "1: of the screw's track, which a force sensor at the table does not feel; 0: of the guide's"},
};
// clang-format on

inline constexpr EffectEntry local_friction{
    .id = "local_friction",
    .component = EffectComponent::guide,
    .work = EffectWork::none,
    .meaning = "friction of the guide or the screw is raised at one place of the stroke",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "position_friction hard_stop",
    .exciting_move = "slow moves over the whole stroke, both directions",
    .parameters = local_friction_parameters,
    .make = make_effect<LocalFriction>,
    .hooks = hooks_of<LocalFriction>(),
};

}  // namespace feedtwin::plant::effects
