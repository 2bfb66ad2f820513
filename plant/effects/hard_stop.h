#pragma once
// Something solid in the way: a spring and damper beyond a place, pushing only back.
//
//   F = k d + c v  while the table is beyond the place by d and F pushes back, else 0
//
// k = stiffness_N_per_m, c = damping_Ns_per_m. The law is that of the end stops (plant/integrator.h).

#include <algorithm>
#include <array>

#include "plant/effects/entry.h"
#include "plant/integrator.h"

namespace feedtwin::plant::effects {

class HardStop final : public Effect {
 public:
  HardStop(const EffectContext& context, const EffectSetting& setting) {
    const bool above = setting.values[1] >= 0.0;
    constexpr double nowhere_m = 1e9;
    stop_.stop_high_m = above ? setting.values[0] : nowhere_m;
    stop_.stop_low_m = above ? -nowhere_m : setting.values[0];
    stop_.stop_stiffness_N_per_m = setting.values[2];
    stop_.stop_damping_Ns_per_m = setting.values[2] > 0.0 ? setting.values[3] : 0.0;
    reset(context.axis.axis.stroke_centre_m);
  }
  void reset(double position_m) noexcept override {
    position_m_ = position_m;
    start_J_ = spring_J();
  }
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const auto stop = end_stop_load<double>(stop_, m.position_m, m.velocity_m_per_s, m.h_s);
    return {stop.force_N, stop.force_slope_Ns_per_m};
  }
  void advance(const EffectMotion& m) noexcept override { position_m_ = m.position_m + m.velocity_m_per_s * m.h_s; }
  [[nodiscard]] double stored_J() const noexcept override { return spring_J() - start_J_; }

 private:
  [[nodiscard]] double spring_J() const noexcept {
    const double depth_m = std::max(position_m_ - stop_.stop_high_m, 0.0) + std::min(position_m_ - stop_.stop_low_m, 0.0);
    return 0.5 * stop_.stop_stiffness_N_per_m * depth_m * depth_m;
  }
  AxisModel<double> stop_;  ///< only its end stops
  double position_m_ = 0.0, start_J_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array hard_stop_parameters{
    EffectParameter{"position_m", "m", -100.0, 100.0, {}, {}, "table position where it begins"},
    EffectParameter{"direction", "1", -1.0, 1.0, 1.0, {}, "1: stops positive motion beyond the place; -1 (below 0): negative motion before it"},
    EffectParameter{"stiffness_N_per_m", "N/m", 0.0, 1000000000.0, 10000000.0, 0.0, "of the obstacle"},
    EffectParameter{"damping_Ns_per_m", "N s/m", 0.0, 1000000.0, 10000.0, {}, "of the obstacle while it is touched"},
};
// clang-format on

inline constexpr EffectEntry hard_stop{
    .id = "hard_stop",
    .component = EffectComponent::load,
    .work = EffectWork::dissipates,
    .meaning = "something solid within the stroke stops the table",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "local_friction torque_saturation",
    .exciting_move = "a slow move over the whole stroke",
    .parameters = hard_stop_parameters,
    .make = make_effect<HardStop>,
    .hooks = hooks_of<HardStop>(),
};

}  // namespace feedtwin::plant::effects
