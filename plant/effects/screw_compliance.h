#pragma once
// The screw, its bearings and the nut give: a spring between motor and table.
//
//   F_nut = k d + c dd/dt,   d = x_screw - x_table
//
// k = stiffness_N_per_m (axial and torsional together), c = damping_Ns_per_m. The motor's encoder sits before the spring,
// scale and guide behind it. The equations are in plant/effects/coupling.h.

#include <array>

#include "plant/effects/coupling.h"
#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class ScrewCompliance final : public Effect {
 public:
  ScrewCompliance(const EffectContext& /*context*/, const EffectSetting& setting)
      : own_{.stiffness_N_per_m = setting.values[0], .damping_Ns_per_m = setting.values[1]} {}

  void join(CouplingParameters& coupling) const noexcept override {
    if (own_.stiffness_N_per_m < rigid_N_per_m) coupling = in_series(coupling, own_);
  }

 private:
  static constexpr double rigid_N_per_m = 1e10;  ///< from here on there is no spring
  CouplingParameters own_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array screw_compliance_parameters{
    EffectParameter{"stiffness_N_per_m", "N/m", 100000.0, 10000000000.0, {}, 10000000000.0, "axial and torsional stiffness together, at the table"},
    EffectParameter{"damping_Ns_per_m", "N s/m", 0.0, 1000000.0, 2000.0, {}, "damping beside the spring"},
};
// clang-format on

inline constexpr EffectEntry screw_compliance{
    .id = "screw_compliance",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "the screw, its bearings and the nut give under load: the table lags and swings against the motor",
    .channels = "torque_cmd_Nm position_m power_W scale_position_m torque_sensor_Nm force_sensor_N",
    .confused_with = "backlash presliding_memory encoder_eccentricity",
    .exciting_move = "strong accelerations with a scale at the table; a sweep through 100 to 600 Hz",
    .parameters = screw_compliance_parameters,
    .make = make_effect<ScrewCompliance>,
    .hooks = hooks_of<ScrewCompliance>(),
};

}  // namespace feedtwin::plant::effects
