#include "controllers/gcode/program_controller.h"

#include <utility>

#include "controllers/gcode/contour_error.h"

namespace feedtwin::controllers::gcode {

ProgramController::ProgramController(Trajectory trajectory, EngagementMap engagement, const CascadeGains& x,
                                     const CascadeGains& y, double speed_override)
    : trajectory_(std::move(trajectory)),
      engagement_(std::move(engagement)),
      x_(x),
      y_(y),
      speed_override_(speed_override) {}

void ProgramController::switch_on_time() noexcept {
  const auto& events = trajectory_.events();
  for (; next_event_ < events.size() && events[next_event_].time_s <= time_s_; ++next_event_) {
    const Action& action = events[next_event_].action;
    if (const auto* spindle = std::get_if<SetSpindle>(&action)) {
      const double sign = spindle->turn == SpindleTurn::clockwise ? 1.0 : spindle->turn == SpindleTurn::off ? 0.0 : -1.0;
      command_.spindle_speed_rad_per_s = sign * speed_override_ * spindle->speed_rad_per_s;
    } else if (const auto* coolant = std::get_if<SetCoolant>(&action)) {
      command_.pump = coolant->mist || coolant->flood;
    }
  }
}

const plant::MachineCommand& ProgramController::step(double x_m, double y_m, double tick_s) noexcept FEEDTWIN_REALTIME {
  if (!started_) {
    x_.reset(x_m);
    y_.reset(y_m);
    started_ = true;
  }
  switch_on_time();
  setpoint_ = trajectory_.at(time_s_, cursor_);
  const auto reference = [this](int axis) {
    return Reference{setpoint_.at_m[axis], setpoint_.velocity_m_per_s[axis], setpoint_.acceleration_m_per_s2[axis]};
  };
  command_.torque_x_Nm = x_.torque_Nm(reference(0), x_m, tick_s);
  command_.torque_y_Nm = y_.torque_Nm(reference(1), y_m, tick_s);
  command_.engagement = setpoint_.moving ? engagement_.at(setpoint_.segment, setpoint_.along_m) : plant::Engagement{};
  time_s_ += tick_s;
  return command_;
}

double ProgramController::contour_error_m(double x_m, double y_m) const noexcept FEEDTWIN_REALTIME {
  return gcode::contour_error_m(trajectory_.segments(), setpoint_.segment, x_m, y_m);
}

}  // namespace feedtwin::controllers::gcode
