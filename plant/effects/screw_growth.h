#pragma once
// The warming screw grows from its fixed bearing.
//
//   x_table = x + (e + (b - e) exp(-t / T)) (x - x_f)
//
// e = relative_growth (11.7e-6 a kelvin for steel), T = time_constant_s, x_f = fixed_end_m, b = initial_growth, t since the
// run began. Seen by the scale alone.

#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class ScrewGrowth final : public Effect {
 public:
  ScrewGrowth(const EffectContext& /*context*/, const EffectSetting& setting)
      : growth_(setting.values[0]),
        time_constant_s_(setting.values[1]),
        fixed_m_(setting.values[2]),
        before_(setting.values[3]) {}

  void tick(const TickStart& start) noexcept override {
    share_ = growth_ + (before_ - growth_) * std::exp(-(start.time_s + start.tick_s) / time_constant_s_);
  }
  void sense(SensedTravel& travel) noexcept override { travel.scale_m += share_ * (travel.shaft_m - fixed_m_); }

 private:
  double growth_, time_constant_s_, fixed_m_, before_;
  double share_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array screw_growth_parameters{
    EffectParameter{"relative_growth", "1", -0.001, 0.001, {}, 0.0, "growth for each metre from the fixed bearing after a long time; positive: longer"},
    EffectParameter{"time_constant_s", "s", 0.001, 1000000.0, 600.0, {}, "time after which 63 % of the growth is reached"},
    EffectParameter{"fixed_end_m", "m", -100.0, 100.0, -0.075, {}, "table position of the fixed bearing"},
    EffectParameter{"initial_growth", "1", -0.001, 0.001, 0.0, {}, "growth for each metre that a run begins with: it begins warm"},
};
// clang-format on

inline constexpr EffectEntry screw_growth{
    .id = "screw_growth",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "the screw grows with heat from its fixed bearing",
    .channels = "scale_position_m temperature_C",
    .confused_with = "lead_error sensor_gain",
    .exciting_move = "the same positions approached over tens of minutes with a scale at the table",
    .parameters = screw_growth_parameters,
    .make = make_effect<ScrewGrowth>,
    .hooks = hooks_of<ScrewGrowth>(),
};

}  // namespace feedtwin::plant::effects
