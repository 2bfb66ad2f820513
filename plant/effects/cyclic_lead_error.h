#pragma once
// The table's travel wobbles about the shaft's with the screw's angle.
//
//   x_table = x + A sin(n theta + phase),   theta = 2 pi x / p_b
//
// A = amplitude_m, n = cycles_per_rev. Seen by the scale alone.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

class CyclicLeadError final : public Effect {
 public:
  CyclicLeadError(const EffectContext& context, const EffectSetting& setting)
      : amplitude_m_(setting.values[0]), wave_(context.axis.axis.lead_m, setting.values[1], setting.values[2]) {}
  void sense(SensedTravel& travel) noexcept override {
    if (amplitude_m_ != 0.0) travel.scale_m += amplitude_m_ * wave_.at(travel.shaft_m);
  }

 private:
  double amplitude_m_;
  RevolutionWave wave_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array cyclic_lead_error_parameters{
    EffectParameter{"amplitude_m", "m", 0.0, 0.001, {}, 0.0, "half of the wobble from peak to peak"},
    EffectParameter{"cycles_per_rev", "1/rev", 0.05, 1000.0, 1.0, {}, "periods in a revolution"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "phase at table position 0"},
};
// clang-format on

inline constexpr EffectEntry cyclic_lead_error{
    .id = "cyclic_lead_error",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "the table's travel wobbles about the shaft's with every revolution",
    .channels = "scale_position_m",
    .confused_with = "encoder_eccentricity lead_error",
    .exciting_move = "a slow move over several revolutions with a scale at the table",
    .parameters = cyclic_lead_error_parameters,
    .make = make_effect<CyclicLeadError>,
    .hooks = hooks_of<CyclicLeadError>(),
};

}  // namespace feedtwin::plant::effects
