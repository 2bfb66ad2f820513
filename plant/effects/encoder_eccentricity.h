#pragma once
// The encoder's disc sits off centre: the count wobbles about the shaft's angle.
//
//   shown = x + A sin(n theta + phase),   theta = 2 pi x / p_b
//
// A = amplitude_m as table travel, n = cycles_per_rev. Constant in micrometres whatever the speed.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

class EncoderEccentricity final : public Effect {
 public:
  EncoderEccentricity(const EffectContext& context, const EffectSetting& setting)
      : amplitude_m_(setting.values[0]), wave_(context.axis.axis.lead_m, setting.values[1], setting.values[2]) {}
  void sense(SensedTravel& travel) noexcept override {
    if (amplitude_m_ != 0.0) travel.shaft_m += amplitude_m_ * wave_.at(travel.shaft_m);
  }

 private:
  double amplitude_m_;
  RevolutionWave wave_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array encoder_eccentricity_parameters{
    EffectParameter{"amplitude_m", "m", 0.0, 0.001, {}, 0.0, "half of the wobble from peak to peak, as table travel"},
    EffectParameter{"cycles_per_rev", "1/rev", 0.1, 4096.0, 1.0, {}, "periods in a revolution"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "phase at table position 0"},
};
// clang-format on

inline constexpr EffectEntry encoder_eccentricity{
    .id = "encoder_eccentricity",
    .component = EffectComponent::sensors,
    .work = EffectWork::none,
    .meaning = "the encoder's count wobbles about the shaft's angle with every revolution",
    .channels = "position_m torque_cmd_Nm",
    .confused_with = "rev_ripple cyclic_lead_error cogging",
    .exciting_move = "steady moves at two speeds over several revolutions",
    .parameters = encoder_eccentricity_parameters,
    .make = make_effect<EncoderEccentricity>,
    .hooks = hooks_of<EncoderEccentricity>(),
};

}  // namespace feedtwin::plant::effects
