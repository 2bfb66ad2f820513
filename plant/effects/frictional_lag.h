#pragma once
// Friction follows a change of speed late (Hess and Soom: the lubricant film takes time).
//
//   frictional_lag               T du/dt = |v| - u   on ball screw and guide
//   frictional_lag_of_velocity   T du/dt =  v  - u   on the ball screw: through zero at a reversal
//
//   g(|u|) in place of g(|v|),   mu u in place of mu |v| (of mu v)
//
// T = time_constant_s. The sliding part acts through the LuGre bristles. The viscous part of the first fades out below 0.1
// mm/s, so that nothing pushes an axis at rest; that of the second is the film's own, which comes to rest after the axis.

#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

template <bool of_velocity>
class FrictionalLag final : public Effect {
 public:
  FrictionalLag(const EffectContext& context, const EffectSetting& setting)
      : screw_(context.axis.ball_screw), guide_(context.axis.guide), time_constant_s_(setting.values[0]) {}

  void reset(double /*position_m*/) noexcept override { film_m_per_s_ = 0.0; }

  void scale(const EffectMotion& m, FrictionScale<double>& scale) const noexcept override {
    if (time_constant_s_ == 0.0) return;
    const double speed = std::abs(m.velocity_m_per_s);
    const double film = std::abs(mean_film_m_per_s(m, remaining(m.h_s)));
    scale.screw_sliding *= ratio(screw_, m.sign, film, speed);
    if constexpr (!of_velocity) scale.guide_sliding *= ratio(guide_, m.sign, film, speed);
  }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    if (time_constant_s_ == 0.0) return {};
    const double left = remaining(m.h_s), film = mean_film_m_per_s(m, left);
    if constexpr (of_velocity) {
      const Directional& mu = screw_.viscous_Ns_per_m;
      const double of_film = film < 0.0 ? mu.neg : mu.pos, of_axis = m.sign > 0.0 ? mu.pos : mu.neg;
      return {of_film * film - of_axis * m.velocity_m_per_s, of_film * (1.0 - left) - of_axis};
    }
    constexpr double v0_m_per_s = 1e-4;
    const double speed = std::abs(m.velocity_m_per_s);
    const double forth = m.velocity_m_per_s < 0.0 ? -1.0 : 1.0;
    const double mu = m.sign > 0.0 ? screw_.viscous_Ns_per_m.pos + guide_.viscous_Ns_per_m.pos
                                   : screw_.viscous_Ns_per_m.neg + guide_.viscous_Ns_per_m.neg;
    const double late = film - speed;
    const double fade = speed / (speed + v0_m_per_s);
    const double fade_slope = v0_m_per_s / ((speed + v0_m_per_s) * (speed + v0_m_per_s));
    return {forth * mu * late * fade, mu * (late * fade_slope - left * fade)};
  }

  void advance(const EffectMotion& m) noexcept override {
    if (time_constant_s_ == 0.0) return;
    const double now = followed_m_per_s(m);
    film_m_per_s_ = now + (film_m_per_s_ - now) * std::exp(-m.h_s / time_constant_s_);
  }

 private:
  [[nodiscard]] static double followed_m_per_s(const EffectMotion& m) noexcept {
    return of_velocity ? m.velocity_m_per_s : std::abs(m.velocity_m_per_s);
  }
  /// Mean share of the old lag over a sub-step.
  [[nodiscard]] double remaining(double h_s) const noexcept {
    const double y = h_s / time_constant_s_;
    return y > 1e-6 ? (1.0 - std::exp(-y)) / y : 1.0 - 0.5 * y;
  }
  [[nodiscard]] double mean_film_m_per_s(const EffectMotion& m, double left) const noexcept {
    const double now = followed_m_per_s(m);
    return now + (film_m_per_s_ - now) * left;
  }
  [[nodiscard]] static double ratio(const LugreParameters& p, double sign, double film, double speed) noexcept {
    const bool pos = sign > 0.0;
    const double coulomb = pos ? p.coulomb_N.pos : p.coulomb_N.neg;
    const double rise = (pos ? p.static_N.pos : p.static_N.neg) - coulomb;
    const double per_stribeck = 1.0 / (pos ? p.stribeck_m_per_s.pos : p.stribeck_m_per_s.neg);
    return (coulomb + rise * exp_of_minus<double>(film * per_stribeck)) /
           (coulomb + rise * exp_of_minus<double>(speed * per_stribeck));
  }

  LugreParameters screw_, guide_;
  double time_constant_s_;
  double film_m_per_s_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array frictional_lag_parameters{
    EffectParameter{"time_constant_s", "s", 0.0, 0.2, {}, 0.0, "time after which friction has followed 63 % of a change of speed"},
};
// clang-format on

inline constexpr EffectEntry frictional_lag{
    .id = "frictional_lag",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::alters_friction,
    .meaning = "friction follows a change of speed late",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "input_delay current_loop_lag channel_skew",
    .exciting_move = "fast speed changes about a low mean speed without reversal",
    .parameters = frictional_lag_parameters,
    .make = make_effect<FrictionalLag<false>>,
    .hooks = hooks_of<FrictionalLag<false>>(),
};

inline constexpr EffectEntry frictional_lag_of_velocity{
    .id = "frictional_lag_of_velocity",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::exchanges,  // after a reversal its film drives the axis for a moment
    .meaning = "friction of the ball screw follows the velocity late, through zero at a reversal",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "frictional_lag input_delay current_loop_lag",
    .exciting_move = "fast speed changes about a low mean speed, with and without reversal",
    .parameters = frictional_lag_parameters,
    .make = make_effect<FrictionalLag<true>>,
    .hooks = hooks_of<FrictionalLag<true>>(),
};

}  // namespace feedtwin::plant::effects
