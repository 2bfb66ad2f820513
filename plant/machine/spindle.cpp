#include "plant/machine/spindle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedtwin::plant {

void Spindle::step(double speed_cmd_rad_per_s, double cutting_torque_Nm, double tick_s) noexcept FEEDTWIN_REALTIME {
  // drive: ramped reference, PI with the integral limited to what the motor can give
  const double most = p_.acceleration_rad_per_s2 * tick_s;
  reference_ += std::clamp(speed_cmd_rad_per_s - reference_, -most, most);
  const double gain = p_.inertia_kgm2 * p_.bandwidth_rad_per_s;
  const double error = reference_ - speed_;
  integral_Nm_ = std::clamp(integral_Nm_ + 0.25 * gain * p_.bandwidth_rad_per_s * error * tick_s, -p_.torque_limit_Nm,
                            p_.torque_limit_Nm);
  if (reference_ == 0.0 && speed_ == 0.0) integral_Nm_ = 0.0;
  torque_ = std::clamp(gain * error + integral_Nm_, -p_.torque_limit_Nm, p_.torque_limit_Nm);

  // mid-point rule: with w the mean speed, J (w1 - w0) / h = T - D sign - mu w - T_cut, and the energies add up exactly
  double sign = speed_ > 0.0 ? 1.0 : speed_ < 0.0 ? -1.0 : 0.0;
  double next = 0.0;
  if (sign == 0.0 && std::abs(torque_) > p_.coulomb_Nm) sign = torque_ > 0.0 ? 1.0 : -1.0;
  if (sign != 0.0) {
    const double inertia = p_.inertia_kgm2 / tick_s, half_viscous = 0.5 * p_.viscous_Nms;
    const double resisting = sign * (p_.coulomb_Nm + cutting_torque_Nm);
    next = (speed_ * (inertia - half_viscous) + torque_ - resisting) / (inertia + half_viscous);
    if (next * sign < 0.0) next = 0.0;  // friction stops, it does not reverse
  }
  const double mean = 0.5 * (speed_ + next), path = mean * tick_s;
  const double kinetic = 0.5 * p_.inertia_kgm2 * next * next;
  const double shaft = torque_ * path, cutting = cutting_torque_Nm * std::abs(path);
  energy_.shaft_work_J += shaft;
  energy_.cutting_J += cutting;
  // in the tick of a stop friction takes whatever is left
  const bool stops = next == 0.0 && speed_ != 0.0;
  energy_.friction_J +=
      stops ? shaft - cutting + energy_.kinetic_J : (p_.coulomb_Nm + p_.viscous_Nms * std::abs(mean)) * std::abs(path);
  energy_.kinetic_J = kinetic;
  const double mean_square = (speed_ * speed_ + speed_ * next + next * next) / 3.0;
  energy_.electrical_J += (p_.ke0_W + p_.ke1_Ws_per_rad * std::abs(mean) + p_.ke2_Ws2_per_rad2 * mean_square) * tick_s;
  speed_ = next;
  angle_ = std::remainder(angle_ + path, 2.0 * std::numbers::pi);
}

SpindleParameters spindle_motor_A() noexcept {
  return {.inertia_kgm2 = 6.33e-5,
          .ke0_W = 3.05e-2,
          .ke1_Ws_per_rad = 2.03e-4,
          .ke2_Ws2_per_rad2 = 6.74e-5,
          .coulomb_Nm = 3.66e-3,
          .viscous_Nms = 3.02e-5,
          .torque_limit_Nm = 0.3};
}

SpindleParameters spindle_motor_B() noexcept {
  return {.inertia_kgm2 = 4.43e-5,
          .ke0_W = 2.14e-2,
          .ke1_Ws_per_rad = 1.42e-4,
          .ke2_Ws2_per_rad2 = 4.71e-5,
          .coulomb_Nm = 2.56e-3,
          .viscous_Nms = 2.13e-5,
          .torque_limit_Nm = 0.21};
}

}  // namespace feedtwin::plant
