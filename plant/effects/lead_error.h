#pragma once
// The screw's true lead differs from the nominal by a constant share: the table travels further than the shaft says.
//
//   x_table = x (1 + e),   e = relative_error
//
// Seen by the scale alone; the force of so small a share (1e-4) is below any noise and left out.

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class LeadError final : public Effect {
 public:
  LeadError(const EffectContext& /*context*/, const EffectSetting& setting) : error_(setting.values[0]) {}
  void sense(SensedTravel& travel) noexcept override { travel.scale_m += error_ * travel.shaft_m; }

 private:
  double error_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array lead_error_parameters{
    EffectParameter{"relative_error", "1", -0.01, 0.01, {}, 0.0, "table travel over shaft travel, less one; positive: the table travels further"},
};
// clang-format on

inline constexpr EffectEntry lead_error{
    .id = "lead_error",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "the table travels further or less than the shaft says by a constant share",
    .channels = "scale_position_m",
    .confused_with = "screw_growth sensor_gain wrong_lead",
    .exciting_move = "one move over the whole stroke with a scale at the table",
    .parameters = lead_error_parameters,
    .make = make_effect<LeadError>,
    .hooks = hooks_of<LeadError>(),
};

}  // namespace feedtwin::plant::effects
