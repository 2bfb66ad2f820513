#pragma once
// A force on the screw that repeats with its revolutions: misalignment, a bent screw, the passing of balls.
//
//   F = A sin(n theta + phase),   theta = 2 pi x / p_b
//
// A = amplitude_N, n = cycles_per_rev (1, 2, or a broken number for the passing of balls). It gives back all that it took.
// Where it is friction that goes up and down so (a preload that varies as the screw turns: ISO 3408-3, variation of dynamic
// preload drag torque), it turns with the motion: F_C and F_S of the ball screw times 1 + A sin(n theta + phase) / F_C,
// never below a hundredth.

#include <algorithm>
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

class RevRippleOfFriction final : public Effect {
 public:
  RevRippleOfFriction(const EffectContext& context, const EffectSetting& setting)
      : amplitude_N_(setting.values[0]),
        wave_(context.axis.axis.lead_m, setting.values[1], setting.values[2]),
        coulomb_N_(context.axis.ball_screw.coulomb_N) {}
  void scale(const EffectMotion& m, FrictionScale<double>& scale) const noexcept override {
    constexpr double least = 0.01, no_friction_N = 1e-9;
    const double coulomb_N = std::max(no_friction_N, m.sign > 0.0 ? coulomb_N_.pos : coulomb_N_.neg);
    scale.screw_sliding *= std::max(least, 1.0 + wave_.mean_N(m, amplitude_N_).force_N / coulomb_N);
  }

 private:
  double amplitude_N_;
  RevolutionWave wave_;
  Directional coulomb_N_;
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

inline constexpr EffectEntry rev_ripple_of_friction{
    .id = "rev_ripple_of_friction",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::alters_friction,
    .meaning = "the screw's sliding friction goes up and down with every revolution",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "rev_ripple position_friction",
    .exciting_move = "slow steady moves over several revolutions, both directions",
    .parameters = rev_ripple_parameters,
    .make = make_effect<RevRippleOfFriction>,
    .hooks = hooks_of<RevRippleOfFriction>(),
};

}  // namespace feedtwin::plant::effects
