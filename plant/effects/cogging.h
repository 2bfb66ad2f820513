#pragma once
// Detent torque of the motor: slots against magnets, whatever the current.
//
//   T = A sin(n theta + phase) against positive motion,   theta = 2 pi x / p_b;   at the table F = 2 pi T / p_b
//
// A = amplitude_Nm, n = cycles_per_rev. Its mean over a sub-step is exact, so that it gives back all that it took.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

class Cogging final : public Effect {
 public:
  Cogging(const EffectContext& context, const EffectSetting& setting)
      : amplitude_N_(setting.values[0] * context.model.transmission_rad_per_m),
        wave_(context.axis.axis.lead_m, setting.values[1], setting.values[2]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override { return wave_.mean_N(m, amplitude_N_); }

 private:
  double amplitude_N_;
  RevolutionWave wave_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array cogging_parameters{
    EffectParameter{"amplitude_Nm", "N m", 0.0, 10.0, {}, 0.0, "half of the torque from peak to peak"},
    EffectParameter{"cycles_per_rev", "1/rev", 0.05, 1000.0, {}, {}, "periods in a revolution"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "phase at table position 0"},
};
// clang-format on

inline constexpr EffectEntry cogging{
    .id = "cogging",
    .component = EffectComponent::motor,
    .work = EffectWork::conserves,
    .meaning = "the motor's torque ripples with the shaft's angle, whatever the current",
    .channels = "torque_cmd_Nm position_m power_W",
    .confused_with = "torque_ripple rev_ripple encoder_eccentricity",
    .exciting_move = "slow steady moves at two loads over several revolutions",
    .parameters = cogging_parameters,
    .make = make_effect<Cogging>,
    .hooks = hooks_of<Cogging>(),
};

}  // namespace feedtwin::plant::effects
