#pragma once
// The truth behind a challenge case: a feed drive of its own making. It shares no friction code and no integrator with
// plant/; names of effects and of their numbers are those of the catalogue, their laws are written here a second time.

#include <array>
#include <string>
#include <vector>

namespace feedtwin::challenge {

/// One direction of motion of a friction contact.
struct Side {
  double coulomb_N, static_N, stribeck_m_per_s, viscous_Ns_per_m;
};

struct Friction {
  Side pos, neg;
  double stiffness_N_per_m, damping_Ns_per_m;
  double slip_m;  ///< Maxwell-slip only: travel at which the last element slips
};

/// The axis as it really is; Table 2 with a spread of its own.
struct Axis {
  double lead_m = 0.005, stroke_m = 0.15, counts_per_rev = 65536.0;
  double motor_inertia_kgm2 = 4.0e-5, screw_inertia_kgm2 = 1.5e-5, table_kg = 4.0;
  double motor_damping_pos_Nms = 4.8e-4, motor_damping_neg_Nms = 3.3e-4, motor_coulomb_pos_N = 36.5,
         motor_coulomb_neg_N = 16.2;
  double ke0_W = 0.25, ke1_pos = 2.1, ke1_neg = 18.1, ke2_pos = 1370.0, ke2_neg = 1610.0;
  double torque_limit_Nm = 1.9;
  Friction screw{{69.8, 82.0, 9.4e-4, 2.2e3}, {64.6, 82.9, 7.5e-4, 2.0e3}, 5.08e7, 7706.0, 6e-6};
  Friction guide{{5.2, 10.4, 2.7e-3, 59.8}, {5.4, 9.1, 3.3e-3, 55.8}, 5.09e5, 1222.0, 4e-5};
  bool maxwell_slip = false;      ///< friction of eight elements instead of one bristle
  double coupling_N_per_m = 0.0;  ///< between screw and table; 0: rigid
  double coupling_damping_Ns_per_m = 0.0;
};

struct Wave {
  double amplitude = 0.0, cycles_per_rev = 1.0, phase_rad = 0.0;
};

/// Every effect, neutral unless set.
struct Effects {
  Wave cogging, torque_ripple, rev_ripple, cyclic_lead_error, encoder_eccentricity;
  double gap_m = 0.0;
  double lead_error = 0.0, screw_growth = 0.0, screw_growth_s = 600.0, screw_fixed_end_m = -0.075;
  double position_friction = 0.0;
  double local_height_N = 0.0, local_centre_m = 0.0, local_half_width_m = 1e-3;
  double sublinear_exponent = 1.0, sublinear_speed_m_per_s = 0.1;
  double memory_N = 0.0, memory_m = 1e-5;
  double dwell_rise = 0.0, dwell_s = 10.0, dwell_memory_m = 2e-5;
  double frictional_lag_s = 0.0;
  double thermal_reduction = 0.0, thermal_J = 20.0;
  double drift_change = 0.0, drift_s = 5.0;
  double load_friction = 0.0;
  double cable_N_per_m = 0.0, cable_neutral_m = 0.0;
  double current_loop_s = 0.0, input_delay_s = 0.0, saturation_Nm = 1e9, torque_gain = 0.0, torque_offset_Nm = 0.0;
  double hidden_Nm = 0.0, hidden_m_per_s = 1e-3;
  double payload_kg = 0.0, gravity_N = 0.0, drag_Ns2_per_m2 = 0.0;
  double line_phase_rad = 0.0;  ///< of floor and process where a run begins
  double floor_m_per_s2 = 0.0, floor_Hz = 20.0;
  double process_mean_N = 0.0, process_N = 0.0, process_Hz = 100.0;
  double stop_N_per_m = 0.0, stop_m = 1.0, stop_Ns_per_m = 1e4;
  double copper_W_per_Nm2 = 0.0, regeneration_lost = 0.0, meter_window_s = 0.1;
  double count_loss = 0.0, count_angle_rad = 3.141592653589793;
  double scale_gain = 1.0, torque_sensor_gain = 1.0, force_sensor_gain = 1.0, power_gain = 1.0;
  double torque_sensor_delay_s = 0.0, force_sensor_delay_s = 0.0, scale_delay_s = 0.0;
  double lead_factor = 1.0, torque_sensor_sign = 1.0, force_sensor_sign = 1.0;
  // outside the catalogue
  double bowl_viscous = 0.0;     ///< viscous friction times 1 + b (x / 50 mm)^2
  double braking_mass_kg = 0.0;  ///< inertia that acts only while braking
  double beat_N = 0.0;           ///< sliding friction that beats with time
  double beat_Hz = 1.3;
  double dead_zone_Nm = 0.0;  ///< of the drive's torque
  double slosh_kg = 0.0;      ///< a mass on a soft spring on the table
  double slosh_Hz = 4.0;
  double washboard_Ns_per_m = 0.0;  ///< viscous friction that waves over the travel at 17 mm
};

/// Sensors' imperfections.
struct Noise {
  double torque_sensor_Nm = 5e-4, force_sensor_N = 0.05, encoder_counts = 0.0;
  double colour = 0.0;             ///< share of the last sample in the next, sensors
  double burst_share = 0.0;        ///< share of time at five times the noise
  double disturbance_N = 0.0;      ///< rms of a coloured force on the screw
  double disturbance_s = 0.01;     ///< its correlation time
  double grid_phase_counts = 0.0;  ///< where the encoder's grid stands against the axis at rest
};

/// One sample of a run, as the sensors show it; `true_` are for the generator's own bookkeeping.
struct Sample {
  double time_s, torque_cmd_Nm, position_m, scale_position_m, torque_sensor_Nm, force_sensor_N, power_W;
  double true_velocity_m_per_s, true_acceleration_m_per_s2;
};
using Run = std::vector<Sample>;

}  // namespace feedtwin::challenge
