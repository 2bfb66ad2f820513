#pragma once
// Quick stop: the drive brings the axis to rest with its own motor, by a velocity loop that only ever brakes. CiA 402, 605A.

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/port.h"
#include "plant/feed_axis.h"
#include "plant/realtime.h"

namespace feedtwin::rt {

/// One axis's stop, from the tick in which it begins to the end of the state.
///
///     v_r <- max(v_r - a dt, 0),  v_r = |v| at first       ramp; a = 0 asks for none: v_r = 0
///     T = -sign(v) clamp(M (|v| - v_r) p_b / (2 pi n dt), 0, T_most)
///
/// M: all inertia as mass at the table, p_b: lead, n = 3 ticks: what the ramp leaves of speed decays by a third a tick, slow
/// enough not to swing, and friction does the rest. Friction that brakes harder than the ramp is left to do so.
class QuickStop {
 public:
  /// Before the stop, each tick.
  void idle() noexcept FEEDTWIN_REALTIME { ramp_m_per_s_ = std::numeric_limits<double>::infinity(); }

  /// The braking torque of this tick. Wait-free.
  [[nodiscard]] double torque_Nm(const plant::FeedAxis& axis, const io::AxisRequest& request,
                                 double tick_s) noexcept FEEDTWIN_REALTIME {
    constexpr double ticks_to_settle = 3.0;
    const plant::MotorParameters& motor = axis.parameters().motor;
    const double wanted_Nm = request.brake_limit_Nm >= 0.0 ? request.brake_limit_Nm : motor.rated_torque_Nm;
    const double most_Nm = std::min(wanted_Nm, axis.parameters().axis.torque_limit_Nm);
    const double velocity = axis.signals().velocity_m_per_s, speed = std::abs(velocity);
    ramp_m_per_s_ =
        request.brake_m_per_s2 > 0.0 ? std::max(std::min(ramp_m_per_s_, speed) - request.brake_m_per_s2 * tick_s, 0.0) : 0.0;
    const double force_N = axis.model().mass_kg * (speed - ramp_m_per_s_) / (ticks_to_settle * tick_s);
    return -std::copysign(std::clamp(force_N / axis.model().transmission_rad_per_m, 0.0, most_Nm), velocity);
  }

 private:
  double ramp_m_per_s_ = std::numeric_limits<double>::infinity();
};

}  // namespace feedtwin::rt
