#pragma once
// Parameters of one ball-screw feed axis: the source paper's Table 2, by component and by direction
// of motion. SI units throughout; the unit is in each name.

#include <vector>

#include "plant/effects/setting.h"

namespace feedtwin::plant {

/// A value that differs with the direction of motion (Table 2's two columns).
struct Directional {
  double pos = 0.0;  ///< while the table moves in the positive direction
  double neg = 0.0;  ///< while it moves in the negative direction
  bool operator==(const Directional&) const = default;
};

/// One LuGre friction contact, Eqs. 2-3. Forces act on the table; Stribeck exponent 1 as printed.
struct LugreParameters {
  Directional coulomb_N;           ///< F_C
  Directional static_N;            ///< F_S, breakaway force; never below F_C
  Directional stribeck_m_per_s;    ///< v_S
  Directional viscous_Ns_per_m;    ///< mu
  double stiffness_N_per_m = 0.0;  ///< sigma_0, bristle stiffness
  double damping_Ns_per_m = 0.0;   ///< sigma_1, bristle damping
  bool operator==(const LugreParameters&) const = default;
};

/// Motor: rotor inertia, damping and Coulomb friction (Eqs. 1, 8), electrical loss (Eq. 7).
struct MotorParameters {
  double inertia_kgm2 = 0.0;                    ///< J_M
  Directional damping_Nms;                      ///< B_M
  Directional coulomb_N;                        ///< F_M, as a force at the table
  double electrical_idle_W = 0.0;               ///< k_e0
  Directional electrical_linear_Ws_per_m;       ///< k_e1
  Directional electrical_quadratic_Ws2_per_m2;  ///< k_e2
  double rated_torque_Nm = 1.27;                ///< full scale of relative torque commands (CiA 402, Modbus)
  bool operator==(const MotorParameters&) const = default;
};

/// Axis-level numbers: transmission, travel, limits, encoder.
struct TransmissionParameters {
  double lead_m = 0.005;         ///< p_b
  double stroke_m = 0.15;        ///< distance between the end stops
  double stroke_centre_m = 0.0;  ///< position of mid-stroke
  double torque_limit_Nm = 1.9;  ///< drive's torque limit
  double encoder_counts_per_rev = 65536.0;
  double end_stop_stiffness_N_per_m = 2.0e7;
  double end_stop_damping_Ns_per_m = 2.0e4;
  double friction_laws_on_guide = 0.0;  ///< 1: laws that change the ball screw's friction change the guide's
  bool operator==(const TransmissionParameters&) const = default;
};

/// A whole axis: Eq. 1.
struct AxisParameters {
  TransmissionParameters axis;
  MotorParameters motor;
  double ball_screw_inertia_kgm2 = 0.0;  ///< J_B
  LugreParameters ball_screw;
  double guide_mass_kg = 0.0;  ///< M_L, table with the guide's blocks
  LugreParameters guide;
  double power_meter_window_s = 0.1;   ///< the source's meter: 10 readings a second
  double power_meter_readings = 1.0;   ///< that a window spans: windows overlap where it is more than one
  std::vector<EffectSetting> effects;  ///< physics beyond Eq. 1 that is switched on (plant/effects/registry.h)

  [[nodiscard]] bool laws_on_guide() const noexcept { return axis.friction_laws_on_guide > 0.5; }
  /// The contact that laws of friction change.
  [[nodiscard]] const LugreParameters& contact_of_laws() const noexcept { return laws_on_guide() ? guide : ball_screw; }
  bool operator==(const AxisParameters&) const = default;
};

}  // namespace feedtwin::plant
