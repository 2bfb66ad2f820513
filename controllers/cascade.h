#pragma once
// The cascade of the source's controller (Fig. 1; Turbo PMAC): position P, velocity PI with feed-forward, current loop.

#include "controllers/controller.h"

namespace feedtwin::controllers {

/// Gains of the cascade. Reduced to the table: the velocity loop's output is a force, turned to torque by p_b / 2 pi.
struct CascadeGains {
  double position_per_s = 60.0;               ///< Kv of the position loop
  double velocity_Ns_per_m = 12000.0;         ///< proportional gain of the velocity loop
  double velocity_integral_N_per_m = 4.0e5;   ///< integral gain of the velocity loop
  double velocity_feedforward = 1.0;          ///< share of the reference velocity fed forward
  double acceleration_feedforward_kg = 90.9;  ///< moving mass fed forward
  double current_loop_time_constant_s = 0.0;  ///< first-order current loop; 0: ideal
  double torque_limit_Nm = 1.9;
  double lead_m = 0.005;
};

class Cascade final : public Controller {
 public:
  explicit Cascade(const CascadeGains& gains) noexcept;
  [[nodiscard]] double torque_Nm(const Reference& reference, double position_m, double tick_s) noexcept override;
  void reset(double position_m) noexcept override;

 private:
  CascadeGains gains_;
  double torque_per_force_m_;
  double last_position_m_ = 0.0;
  double integral_N_ = 0.0;
  double current_loop_Nm_ = 0.0;
};

}  // namespace feedtwin::controllers
