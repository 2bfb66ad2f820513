#pragma once
// Energy of an axis by component, Eqs. 4-10 and 14, integrated by the model's own terms.

#include <cmath>

namespace feedtwin::plant {

/// Since the start, in J. Mechanical entries hold the component's inertial work too, as in Eqs. 8-10.
struct AxisEnergy {
  double motor_electrical_J = 0.0;  ///< Eq. 7: k_e0 t + k_e1 |x'| dt + k_e2 x'^2 dt
  double motor_mechanical_J = 0.0;  ///< Eq. 8
  double ball_screw_J = 0.0;        ///< Eq. 9
  double guide_J = 0.0;             ///< Eq. 10
  double cutting_J = 0.0;           ///< work against the cutting force
  double end_stop_J = 0.0;
  double load_J = 0.0;        ///< work on effects of the load: springs, gravity, drag, process, floor (plant/effects)
  double input_work_J = 0.0;  ///< torque times the motor's angle
  double throughput_J = 0.0;  ///< the same without sign, and the energy at the start: the balance's yardstick
  double kinetic_J = 0.0;     ///< of everything that moves, less that at the start
  double stored_J = 0.0;      ///< in the bristles, and in what effects store, now
  double lost_J = 0.0;        ///< turned to heat, mechanical only

  AxisEnergy& operator+=(const AxisEnergy& more) noexcept {
    for (double AxisEnergy::* entry :
         {&AxisEnergy::motor_electrical_J, &AxisEnergy::motor_mechanical_J, &AxisEnergy::ball_screw_J, &AxisEnergy::guide_J,
          &AxisEnergy::cutting_J, &AxisEnergy::end_stop_J, &AxisEnergy::load_J, &AxisEnergy::input_work_J,
          &AxisEnergy::throughput_J, &AxisEnergy::kinetic_J, &AxisEnergy::stored_J, &AxisEnergy::lost_J}) {
      this->*entry += more.*entry;
    }
    return *this;
  }

  /// |work in - work on the components - cutting - end stops - loads| / throughput; 0 before anything has moved.
  [[nodiscard]] double balance_error() const noexcept {
    const double taken_J = motor_mechanical_J + ball_screw_J + guide_J + cutting_J + end_stop_J + load_J;
    return throughput_J > 0.0 ? std::abs(input_work_J - taken_J) / throughput_J : 0.0;
  }
};

}  // namespace feedtwin::plant
