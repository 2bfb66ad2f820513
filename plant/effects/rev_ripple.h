#pragma once
// A force on the screw that repeats with its revolutions: misalignment, a bent screw, the passing of balls.
//
//   F = A sin(n theta + phase),   theta = 2 pi x / p_b
//
// A = amplitude_N, n = cycles_per_rev (1, 2, or a broken number for the passing of balls). It gives back all that it took.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

class RevRipple final : public Effect {
 public:
  RevRipple(const EffectContext& context, const EffectSetting& setting)
      : amplitude_N_(setting.values[0]), wave_(context.axis.axis.lead_m, setting.values[1], setting.values[2]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override { return wave_.mean_N(m, amplitude_N_); }

 private:
  double amplitude_N_;
  RevolutionWave wave_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array rev_ripple_parameters{
    EffectParameter{"amplitude_N", "N", 0.0, 10000.0, {}, 0.0, "half of the force from peak to peak, at the table"},
    EffectParameter{"cycles_per_rev", "1/rev", 0.05, 1000.0, 1.0, {}, "periods in a revolution"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "phase at table position 0"},
};
// clang-format on

inline constexpr EffectEntry rev_ripple{
    .id = "rev_ripple",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::conserves,
    .meaning = "a force of the screw repeats with every revolution, whatever the torque",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "cogging encoder_eccentricity torque_ripple",
    .exciting_move = "slow steady moves over several revolutions, both directions",
    .parameters = rev_ripple_parameters,
    .make = make_effect<RevRipple>,
    .hooks = hooks_of<RevRipple>(),
    .even_in_motion = true,
};

}  // namespace feedtwin::plant::effects
