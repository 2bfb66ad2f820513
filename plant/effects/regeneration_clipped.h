#pragma once
// The drive gives no power back: what braking returns goes to a resistor, and the meter shows none of it.
//
//   P' = P  for P >= 0,   (1 - s) P  for P < 0,   s = share

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class RegenerationClipped final : public Effect {
 public:
  RegenerationClipped(const EffectContext& /*context*/, const EffectSetting& setting) : left_(1.0 - setting.values[0]) {}
  [[nodiscard]] double power_W(const TickPower& power) noexcept override {
    return power.power_W < 0.0 ? left_ * power.power_W : power.power_W;
  }

 private:
  double left_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array regeneration_clipped_parameters{
    EffectParameter{"share", "1", 0.0, 1.0, 1.0, 0.0, "share of the returned power that is lost"},
};
// clang-format on

inline constexpr EffectEntry regeneration_clipped{
    .id = "regeneration_clipped",
    .component = EffectComponent::power,
    .work = EffectWork::none,
    .meaning = "power that braking gives back never reaches the supply",
    .channels = "power_W",
    .confused_with = "copper_loss power_meter_window",
    .exciting_move = "strong braking from full speed",
    .parameters = regeneration_clipped_parameters,
    .make = make_effect<RegenerationClipped>,
    .hooks = hooks_of<RegenerationClipped>(),
};

}  // namespace feedtwin::plant::effects
