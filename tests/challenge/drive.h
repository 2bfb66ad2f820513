#pragma once
// Equations of the true feed drive, for an adaptive integrator.
//
//   (J_M + J_B)(2 pi / p)^2 dv1/dt = (2 pi / p) T - F_M - B v1 - F_screw(v1) - F_nut,   M_L dv2/dt = F_nut - F_guide(v2) -
//   loads
//
// with F_nut = K (x1 - x2) + C (v1 - v2) beyond the gap, or v1 = v2 for a rigid screw.

#include <vector>

#include "tests/challenge/truth.h"

namespace feedtwin::challenge {

using State = std::vector<double>;

class Drive {
 public:
  Drive(const Axis& axis, const Effects& effects);

  [[nodiscard]] State at_rest() const { return State(size_, 0.0); }
  /// Torque that the drive believes in, until the next call.
  void set_torque(double torque_Nm) { command_Nm_ = torque_Nm; }
  /// +1 or -1 while the motor turns, 0 while its Coulomb friction holds it.
  void set_mode(int mode) { mode_ = mode; }
  [[nodiscard]] int mode() const { return mode_; }
  /// The mode out of rest in this state.
  [[nodiscard]] int mode_from_rest(const State& y, double t) const;
  /// What laws take from the last accepted step, so that they need no inner loop.
  void remember(const State& y, double t);

  void operator()(const State& y, State& dy, double t) const;

  struct Forces {
    double torque_sensor_Nm, nut_N, acceleration_m_per_s2;
  };
  [[nodiscard]] Forces forces(const State& y, double t) const;
  [[nodiscard]] double motor_m(const State& y) const { return y[x1]; }
  [[nodiscard]] double motor_m_per_s(const State& y) const { return y[v1]; }
  void stop_motor(State& y) const {
    y[v1] = 0.0;
    if (rigid()) y[v2] = 0.0;
  }
  [[nodiscard]] double table_m(const State& y) const { return rigid() ? y[x1] : y[x2]; }
  [[nodiscard]] double input_J(const State& y) const { return y[input]; }

 private:
  enum Place : std::size_t { x1, v1, x2, v2, current, film, age, work, input, slosh_x, slosh_v, first_element };
  static constexpr std::size_t maxwell_elements = 8;
  struct Contact {
    double force_N = 0.0;
  };
  struct Loads {
    double motor_N, screw_N, table_N;  ///< against positive motion, without the motor's Coulomb friction
    double screw_friction_N;           ///< of screw_N
    double table_kg, drive_N, motor_Nm;
  };

  [[nodiscard]] bool rigid() const { return axis_.coupling_N_per_m <= 0.0; }
  [[nodiscard]] double contact(const Friction& f, std::size_t first, const State& y, State* dy, double v, double film_speed,
                               double sliding, double viscous) const;
  [[nodiscard]] Loads loads(const State& y, State* dy, double t) const;
  [[nodiscard]] double sliding_factor(const State& y, double t, double v) const;
  [[nodiscard]] double coupling_N(const State& y) const;
  [[nodiscard]] double electrical_W(double v, double torque_Nm) const;

  Axis axis_;
  Effects e_;
  double k_, motor_kg_, screw_kg_;
  std::size_t elements_, memory_, size_;
  int mode_ = 0;
  double command_Nm_ = 0.0, last_acceleration_ = 0.0, last_table_N_ = 0.0;
};

}  // namespace feedtwin::challenge
