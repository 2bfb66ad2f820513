#pragma once
// A sensor shows more or less than there is by a constant share.
//
//   shown = gain * true,   one gain for each sensor

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class SensorGain final : public Effect {
 public:
  SensorGain(const EffectContext& /*context*/, const EffectSetting& setting)
      : scale_(setting.values[0]), torque_(setting.values[1]), force_(setting.values[2]), power_(setting.values[3]) {}
  void show(AxisSignals& signals) noexcept override {
    signals.scale_position_m *= scale_;
    signals.metered_power_W *= power_;
    signals.power_W *= power_;
  }
  void show_forces(ForceSignals& forces) const noexcept override {
    forces.torque_sensor_Nm *= torque_;
    forces.force_sensor_N *= force_;
  }

 private:
  double scale_, torque_, force_, power_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array sensor_gain_parameters{
    EffectParameter{"scale_gain", "1", 0.1, 10.0, 1.0, 1.0, "of the linear scale"},
    EffectParameter{"torque_sensor_gain", "1", -10.0, 10.0, 1.0, 1.0, "of the torque sensor; negative: wired in reverse"},
    EffectParameter{"force_sensor_gain", "1", -10.0, 10.0, 1.0, 1.0, "of the force sensor; negative: wired in reverse"},
    EffectParameter{"power_gain", "1", 0.1, 10.0, 1.0, 1.0, "of the power meter"},
};
// clang-format on

inline constexpr EffectEntry sensor_gain{
    .id = "sensor_gain",
    .component = EffectComponent::sensors,
    .work = EffectWork::none,
    .meaning = "a sensor shows more or less than there is by a constant share",
    .channels = "scale_position_m torque_sensor_Nm force_sensor_N power_W",
    .confused_with = "torque_gain_error lead_error payload",
    .exciting_move = "any move; the energy balance between two sensors tells",
    .parameters = sensor_gain_parameters,
    .make = make_effect<SensorGain>,
    .hooks = hooks_of<SensorGain>(),
};

}  // namespace feedtwin::plant::effects
