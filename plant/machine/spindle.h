#pragma once
// Spindle motor with its drive: J dw/dt = T - D_M sign(w) - mu_v w - T_cut, electrical loss k_e0 + k_e1 |w| + k_e2 w^2
// (the source's Table 5, modelled as the servo motor's Eqs. 7 and 8). The drive ramps to the commanded speed and holds it.

#include "plant/realtime.h"

namespace feedtwin::plant {

struct SpindleParameters {
  double inertia_kgm2 = 0.0;               ///< J_M
  double ke0_W = 0.0;                      ///< k_e0, always
  double ke1_Ws_per_rad = 0.0;             ///< k_e1
  double ke2_Ws2_per_rad2 = 0.0;           ///< k_e2
  double coulomb_Nm = 0.0;                 ///< D_M
  double viscous_Nms = 0.0;                ///< mu_v
  double torque_limit_Nm = 0.3;            ///< the drive's
  double acceleration_rad_per_s2 = 600.0;  ///< ramp of the commanded speed
  double bandwidth_rad_per_s = 120.0;      ///< of the drive's speed loop
};

struct SpindleEnergy {
  double electrical_J = 0.0;  ///< k_e0 .. k_e2
  double friction_J = 0.0;    ///< D_M and mu_v
  double cutting_J = 0.0;     ///< work against the cutting torque
  double kinetic_J = 0.0;     ///< now
  double shaft_work_J = 0.0;  ///< motor torque times angle; electrical input is this and electrical_J
};

class Spindle {
 public:
  explicit Spindle(const SpindleParameters& parameters) noexcept : p_(parameters) {}

  /// @param speed_cmd_rad_per_s positive clockwise; @param cutting_torque_Nm against the rotation, >= 0. Wait-free.
  void step(double speed_cmd_rad_per_s, double cutting_torque_Nm, double tick_s) noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] double speed_rad_per_s() const noexcept { return speed_; }
  [[nodiscard]] double angle_rad() const noexcept { return angle_; }
  [[nodiscard]] double torque_Nm() const noexcept { return torque_; }
  [[nodiscard]] const SpindleEnergy& energy() const noexcept { return energy_; }
  [[nodiscard]] const SpindleParameters& parameters() const noexcept { return p_; }

 private:
  SpindleParameters p_;
  double speed_ = 0.0, angle_ = 0.0, torque_ = 0.0;
  double reference_ = 0.0, integral_Nm_ = 0.0;
  SpindleEnergy energy_;
};

/// Table 5; k_e2 a thousandth of what is printed, which would be 6.65 kW at 3000 rpm instead of 6.65 W.
[[nodiscard]] SpindleParameters spindle_motor_A() noexcept;
[[nodiscard]] SpindleParameters spindle_motor_B() noexcept;

}  // namespace feedtwin::plant
