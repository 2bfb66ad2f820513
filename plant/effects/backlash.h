#pragma once
// Play between screw and table: the table follows only when the gap is closed.
//
//   F_nut = k (d - gap / 2) + c dd/dt  for d > gap / 2,  0 within the gap,  mirrored below;   d = x_screw - x_table
//
// gap = gap_m, k and c = the stiffness and damping of the contact beside it; the contact never pulls. The motor's encoder
// sits before the gap, scale and guide behind it. The equations are in plant/effects/coupling.h.

#include <array>

#include "plant/effects/coupling.h"
#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class Backlash final : public Effect {
 public:
  Backlash(const EffectContext& /*context*/, const EffectSetting& setting)
      : own_{.gap_m = setting.values[0], .stiffness_N_per_m = setting.values[1], .damping_Ns_per_m = setting.values[2]} {}

  void join(CouplingParameters& coupling) const noexcept override {
    if (own_.gap_m > 0.0) coupling = in_series(coupling, own_);
  }

 private:
  CouplingParameters own_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array backlash_parameters{
    EffectParameter{"gap_m", "m", 0.0, 0.001, {}, 0.0, "free travel between the two flanks"},
    EffectParameter{"stiffness_N_per_m", "N/m", 100000.0, 10000000000.0, 60000000.0, {}, "of the closed contact; a screw_compliance beside it acts in series"},
    EffectParameter{"damping_Ns_per_m", "N s/m", 0.0, 1000000.0, 2000.0, {}, "of the closed contact"},
};
// clang-format on

inline constexpr EffectEntry backlash{
    .id = "backlash",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "play between screw and table: after a reversal the table waits until the gap is crossed",
    .channels = "torque_cmd_Nm position_m power_W scale_position_m torque_sensor_Nm force_sensor_N",
    .confused_with = "presliding_memory screw_compliance",
    .exciting_move = "slow reversals with a scale at the table",
    .parameters = backlash_parameters,
    .make = make_effect<Backlash>,
    .hooks = hooks_of<Backlash>(),
};

}  // namespace feedtwin::plant::effects
