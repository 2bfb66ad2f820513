#include "controllers/cascade.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedtwin::controllers {

Cascade::Cascade(const CascadeGains& gains) noexcept
    : gains_(gains), torque_per_force_m_(gains.lead_m / (2.0 * std::numbers::pi)) {}

void Cascade::reset(double position_m) noexcept {
  last_position_m_ = position_m;
  integral_N_ = 0.0;
  current_loop_Nm_ = 0.0;
}

double Cascade::torque_Nm(const Reference& reference, double position_m, double tick_s) noexcept {
  const double velocity = (position_m - last_position_m_) / tick_s;
  last_position_m_ = position_m;
  const double wanted_velocity =
      gains_.position_per_s * (reference.position_m - position_m) + gains_.velocity_feedforward * reference.velocity_m_per_s;
  const double velocity_error = wanted_velocity - velocity;
  const double limit_N = gains_.torque_limit_Nm / torque_per_force_m_;
  const double proportional_N =
      gains_.velocity_Ns_per_m * velocity_error + gains_.acceleration_feedforward_kg * reference.acceleration_m_per_s2;
  // anti-windup: the integral never asks for more than the limit leaves
  const double wanted_integral_N = integral_N_ + gains_.velocity_integral_N_per_m * velocity_error * tick_s;
  integral_N_ = std::clamp(wanted_integral_N, std::min(integral_N_, -limit_N - std::min(0.0, proportional_N)),
                           std::max(integral_N_, limit_N - std::max(0.0, proportional_N)));
  integral_N_ = std::clamp(integral_N_, -limit_N, limit_N);
  const double wanted_Nm =
      std::clamp((proportional_N + integral_N_) * torque_per_force_m_, -gains_.torque_limit_Nm, gains_.torque_limit_Nm);
  if (gains_.current_loop_time_constant_s <= 0.0) return wanted_Nm;
  current_loop_Nm_ += (wanted_Nm - current_loop_Nm_) * (1.0 - std::exp(-tick_s / gains_.current_loop_time_constant_s));
  return current_loop_Nm_;
}

}  // namespace feedtwin::controllers
