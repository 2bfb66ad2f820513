#pragma once
// The law of the cascade, for one axis (double) or several at a time (a lane each).
//
//   v_wanted = K_v (x_ref - x) + k_vff v_ref,   v = (x_k - x_k-n) / (n T)
//   F = K_p (v_wanted - v) + K_i int(v_wanted - v) dt + M_ff a_ref + B_ff v_ref + F_ff sgn v_ref + F_ref,   limited, with
//   anti-windup

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "controllers/reference.h"
#include "plant/lanes.h"

namespace feedtwin::controllers {

/// Gains of the cascade. Reduced to the table: the velocity loop's output is a force, turned to torque by p_b / 2 pi.
struct CascadeGains {
  double position_per_s = 60.0;               ///< Kv of the position loop
  double velocity_Ns_per_m = 12000.0;         ///< proportional gain of the velocity loop
  double velocity_integral_N_per_m = 4.0e5;   ///< integral gain of the velocity loop
  double velocity_feedforward = 1.0;          ///< share of the reference velocity fed forward
  double acceleration_feedforward_kg = 90.9;  ///< moving mass fed forward
  double friction_feedforward_N = 0.0;        ///< in the direction of the reference velocity (Turbo PMAC Ixx68)
  double viscous_feedforward_Ns_per_m = 0.0;  ///< by the reference velocity
  double current_loop_time_constant_s = 0.0;  ///< first-order current loop; 0: ideal
  double torque_limit_Nm = 1.9;
  double lead_m = 0.005;
  int velocity_window_samples = 1;  ///< the measured velocity is the mean over so many ticks, 1 to 4
};

template <class Real>
class CascadeLaw {
 public:
  explicit CascadeLaw(const CascadeGains& gains) noexcept
      : gains_(gains), torque_per_force_m_(gains.lead_m / (2.0 * std::numbers::pi)) {}

  void reset(Real position_m) noexcept {
    last_positions_m_.fill(position_m);
    integral_N_ = Real{};
    current_loop_Nm_ = Real{};
  }

  [[nodiscard]] Real torque_Nm(const Reference& reference, Real position_m, double tick_s) noexcept {
    const auto window = static_cast<std::size_t>(std::clamp(gains_.velocity_window_samples, 1, longest_window));
    const Real velocity = (position_m - last_positions_m_[window - 1]) / (static_cast<double>(window) * tick_s);
    std::copy_backward(last_positions_m_.begin(), last_positions_m_.end() - 1, last_positions_m_.end());
    last_positions_m_[0] = position_m;
    const Real wanted_velocity = gains_.position_per_s * (reference.position_m - position_m) +
                                 gains_.velocity_feedforward * reference.velocity_m_per_s;
    const Real velocity_error = wanted_velocity - velocity;
    const double limit_N = gains_.torque_limit_Nm / torque_per_force_m_;
    const Real proportional_N = gains_.velocity_Ns_per_m * velocity_error + feedforward_N(reference);
    // anti-windup: the integral never asks for more than the limit leaves
    const Real zero{};
    const Real wanted_integral_N = integral_N_ + gains_.velocity_integral_N_per_m * velocity_error * tick_s;
    integral_N_ =
        limited(wanted_integral_N, plant::smaller<Real>(integral_N_, -limit_N - plant::smaller<Real>(zero, proportional_N)),
                plant::larger<Real>(integral_N_, limit_N - plant::larger<Real>(zero, proportional_N)));
    integral_N_ = limited(integral_N_, zero - limit_N, zero + limit_N);
    const Real wanted_Nm = limited((proportional_N + integral_N_) * torque_per_force_m_, zero - gains_.torque_limit_Nm,
                                   zero + gains_.torque_limit_Nm);
    if (gains_.current_loop_time_constant_s <= 0.0) return wanted_Nm;
    current_loop_Nm_ += (wanted_Nm - current_loop_Nm_) * (1.0 - std::exp(-tick_s / gains_.current_loop_time_constant_s));
    return current_loop_Nm_;
  }

 private:
  [[nodiscard]] double feedforward_N(const Reference& reference) const noexcept {
    const double v = reference.velocity_m_per_s;
    const double friction_N = v == 0.0 ? 0.0 : std::copysign(gains_.friction_feedforward_N, v);
    return gains_.acceleration_feedforward_kg * reference.acceleration_m_per_s2 + gains_.viscous_feedforward_Ns_per_m * v +
           friction_N + reference.force_N;
  }
  static constexpr int longest_window = 4;
  static Real limited(Real value, Real low, Real high) noexcept {
    return plant::smaller<Real>(plant::larger<Real>(value, low), high);
  }

  CascadeGains gains_;
  double torque_per_force_m_;
  std::array<Real, longest_window> last_positions_m_{};
  Real integral_N_{};
  Real current_loop_Nm_{};
};

}  // namespace feedtwin::controllers
