#pragma once
// Breakaway friction that rises while the axis stands: contacts age (Dieterich's law of rate-and-state friction).
//
//   d(age)/dt = 1 - |v| age / D,   F_C, F_S of the ball screw times 1 + r (1 - exp(-age / T))
//
// r = relative_rise, T = time_constant_s, D = memory_distance_m. Sliding renews the contacts over D, so that only the
// breakaway after a dwell is raised. At constant speed the age is exact: age' = age E + h phi, E = exp(-|v| h / D).

#include <array>
#include <cmath>

#include "plant/effects/entry.h"
#include "plant/effects/law_contact.h"

namespace feedtwin::plant::effects {

class DwellBreakaway final : public Effect {
 public:
  DwellBreakaway(const EffectContext& context, const EffectSetting& setting)
      : contact_(context.axis),
        rise_(setting.values[0]),
        time_constant_s_(setting.values[1]),
        distance_m_(setting.values[2]) {}

  void reset(double /*position_m*/) noexcept override {
    age_s_ = 0.0;
    factor_ = 1.0;
  }

  void scale(const EffectMotion& /*motion*/, FrictionScale<double>& scale) const noexcept override {
    contact_.sliding(scale) *= factor_;
  }

  void advance(const EffectMotion& m) noexcept override {
    const double y = std::abs(m.velocity_m_per_s) * m.h_s / distance_m_;
    const double left = std::exp(-y);
    age_s_ = age_s_ * left + m.h_s * (y > 1e-6 ? (1.0 - left) / y : 1.0 - 0.5 * y);
    factor_ = 1.0 + rise_ * (1.0 - std::exp(-age_s_ / time_constant_s_));
  }

 private:
  LawContact contact_;
  double rise_, time_constant_s_, distance_m_;
  double age_s_ = 0.0, factor_ = 1.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array dwell_breakaway_parameters{
    EffectParameter{"relative_rise", "1", 0.0, 2.0, {}, 0.0, "rise of the breakaway force after a long dwell, over the nominal"},
    EffectParameter{"time_constant_s", "s", 0.01, 10000.0, 10.0, {}, "dwell after which 63 % of the rise is reached"},
    EffectParameter{"memory_distance_m", "m", 1e-06, 0.01, 2e-05, {}, "sliding that renews the contacts"},
};
// clang-format on

inline constexpr EffectEntry dwell_breakaway{
    .id = "dwell_breakaway",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "breakaway friction of the ball screw rises with the time at rest before it",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "presliding_memory frictional_lag",
    .exciting_move = "starts after dwells of 0.1, 1, 10 and 100 s",
    .parameters = dwell_breakaway_parameters,
    .make = make_effect<DwellBreakaway>,
    .hooks = hooks_of<DwellBreakaway>(),
    .even_in_motion = true,
    .of_contact = true,
};

}  // namespace feedtwin::plant::effects
