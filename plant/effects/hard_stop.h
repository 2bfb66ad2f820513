#pragma once
// Something solid in the way: a spring and damper beyond a place, pushing only back.
//
//   F = k d + c v  while the table is beyond the place by d and F pushes back, else 0
//
// k = stiffness_N_per_m, c = damping_Ns_per_m.

#include <algorithm>
#include <array>

#include "plant/effects/contact_spring.h"
#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class HardStop final : public Effect {
 public:
  HardStop(const EffectContext& context, const EffectSetting& setting)
      : place_m_(setting.values[0]),
        direction_(setting.values[1] < 0.0 ? -1.0 : 1.0),
        stiffness_N_per_m_(setting.values[2]),
        damping_Ns_per_m_(setting.values[2] > 0.0 ? setting.values[3] : 0.0) {
    reset(context.axis.axis.stroke_centre_m);
  }

  void reset(double position_m) noexcept override {
    position_m_ = position_m;
    start_J_ = spring_J();
  }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double path_m = m.velocity_m_per_s * m.h_s;
    const double middle_m = depth_m(m.position_m + 0.5 * path_m);
    const SpringMean spring =
        spring_mean(stiffness_N_per_m_, depth_m(m.position_m), middle_m, depth_m(m.position_m + path_m), path_m);
    const EffectLoad load{spring.force_N + (middle_m != 0.0 ? damping_Ns_per_m_ * m.velocity_m_per_s : 0.0),
                          spring.slope_N_per_m * m.h_s + (middle_m != 0.0 ? damping_Ns_per_m_ : 0.0)};
    return load.force_N * direction_ < 0.0 ? EffectLoad{} : load;
  }

  void advance(const EffectMotion& m) noexcept override { position_m_ = m.position_m + m.velocity_m_per_s * m.h_s; }

  [[nodiscard]] double stored_J() const noexcept override { return spring_J() - start_J_; }

 private:
  /// Signed as the force: positive beyond the place where positive motion is stopped.
  [[nodiscard]] double depth_m(double position_m) const noexcept {
    return direction_ * std::max(0.0, direction_ * (position_m - place_m_));
  }
  [[nodiscard]] double spring_J() const noexcept {
    const double depth = depth_m(position_m_);
    return 0.5 * stiffness_N_per_m_ * depth * depth;
  }

  double place_m_, direction_, stiffness_N_per_m_, damping_Ns_per_m_;
  double position_m_ = 0.0, start_J_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array hard_stop_parameters{
    EffectParameter{"position_m", "m", -100.0, 100.0, {}, {}, "table position where it begins"},
    EffectParameter{"direction", "1", -1.0, 1.0, 1.0, {}, "1: stops positive motion beyond the place; -1 (below 0): negative motion before it"},
    EffectParameter{"stiffness_N_per_m", "N/m", 0.0, 1e8, 1e7, 0.0, "of the obstacle"},
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
