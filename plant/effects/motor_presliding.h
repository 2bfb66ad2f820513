#pragma once
// The motor's Coulomb friction where it sets in over a path instead of at once: one bristle (Dahl 1968).
//
//   dF/ds = sigma (1 - F / F_M),   s the path since the reversal, sigma = (F_M+ + F_M-) / (2 x_0), x_0 = distance_m
//
// so that F = F_M - (F_M - F_0) e^-u, u = sigma s / F_M, and over a path its mean is F_M - (F_M - F_0) (1 - e^-u) / u,
// exactly. The bristle holds F^2 / (2 sigma), and loses F^2 / F_M for each metre: one stiffness for both directions, or it
// would make energy to and fro.

#include <algorithm>
#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class MotorPresliding final : public Effect {
 public:
  MotorPresliding(const EffectContext& context, const EffectSetting& setting) : coulomb_N_(context.axis.motor.coulomb_N) {
    const double distance_m = setting.values[0];
    stiffness_N_per_m_ = distance_m > 0.0 ? 0.5 * (coulomb_N_.pos + coulomb_N_.neg) / distance_m : 0.0;
    constexpr double least_N = 1e-9;  // a direction without friction divides by it
    coulomb_N_ = {std::max(coulomb_N_.pos, least_N), std::max(coulomb_N_.neg, least_N)};
  }

  void reset(double /*position_m*/) noexcept override { force_N_ = 0.0; }

  [[nodiscard]] bool is_motor_friction() const noexcept override { return stiffness_N_per_m_ > 0.0; }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    if (stiffness_N_per_m_ <= 0.0) return {};
    const Path path = along(m);
    const double u = path.u, left_N = path.coulomb_N - path.forth * force_N_;
    constexpr double short_path = 1e-3;  // below it by series
    const double mean = u < short_path ? 1.0 - u / 2.0 + u * u / 6.0 : -std::expm1(-u) / u;
    const double fall = u < short_path ? 0.5 - u / 3.0 : (mean - std::exp(-u)) / u;
    return {path.forth * (path.coulomb_N - left_N * mean), left_N * fall * m.h_s * stiffness_N_per_m_ / path.coulomb_N};
  }

  void advance(const EffectMotion& m) noexcept override {
    if (stiffness_N_per_m_ <= 0.0) return;
    const Path path = along(m);
    force_N_ = path.forth * (path.coulomb_N - (path.coulomb_N - path.forth * force_N_) * std::exp(-path.u));
  }

  [[nodiscard]] double stored_J() const noexcept override {
    return stiffness_N_per_m_ > 0.0 ? 0.5 * force_N_ * force_N_ / stiffness_N_per_m_ : 0.0;
  }

 private:
  /// The path of a sub-step: its direction, u, the friction that it leads to.
  struct Path {
    double forth, u, coulomb_N;
  };
  [[nodiscard]] Path along(const EffectMotion& m) const noexcept {
    const double forth = m.velocity_m_per_s < 0.0 ? -1.0 : m.velocity_m_per_s > 0.0 ? 1.0 : m.sign;
    const double coulomb_N = forth < 0.0 ? coulomb_N_.neg : coulomb_N_.pos;
    return {forth, std::abs(m.velocity_m_per_s) * m.h_s * stiffness_N_per_m_ / coulomb_N, coulomb_N};
  }

  Directional coulomb_N_;
  double stiffness_N_per_m_, force_N_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array motor_presliding_parameters{
    EffectParameter{"distance_m", "m", 0.0, 1e-3, {}, 0.0, "travel over which the motor's Coulomb friction sets in, to 1 - 1/e of it; 0: at once"},
};
// clang-format on

inline constexpr EffectEntry motor_presliding{
    .id = "motor_presliding",
    .component = EffectComponent::motor,
    .work = EffectWork::dissipates,
    .meaning = "the motor's Coulomb friction sets in over some path after each reversal instead of at once",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "presliding_memory screw_compliance sensor_gain",
    .exciting_move = "slow reversals of a few micrometres with a torque sensor behind the motor",
    .parameters = motor_presliding_parameters,
    .make = make_effect<MotorPresliding>,
    .hooks = hooks_of<MotorPresliding>(),
};

}  // namespace feedtwin::plant::effects
