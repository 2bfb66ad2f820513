#include "plant/machine/machine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedtwin::plant {
namespace {

/// Slower, a spindle counts as standing: a tooth period of half a minute with two teeth.
constexpr double standing_rad_per_s = 0.1;

}  // namespace

double MachineEnergy::balance_error() const noexcept {
  const auto axis_J = [](const AxisEnergy& a) {
    return a.motor_electrical_J + a.motor_mechanical_J + a.ball_screw_J + a.guide_J + a.end_stop_J;
  };
  const double taken_J =
      axis_J(x) + axis_J(y) + spindle.electrical_J + spindle.friction_J + spindle.kinetic_J + tip_J + pump_J + controller_J;
  return input_J > 0.0 ? std::abs(input_J - taken_J) / input_J : 0.0;
}

ComponentPower mean_power(const MachineEnergy& from, const MachineEnergy& to) noexcept FEEDTWIN_REALTIME {
  const double t = to.time_s - from.time_s;
  if (t <= 0.0) return {};
  return {(to.pump_J - from.pump_J) / t, (to.controller_J - from.controller_J) / t, (to.spindle_J() - from.spindle_J()) / t,
          (to.feed_J() - from.feed_J()) / t};
}

Machine::Machine(const MachineParameters& parameters, Resolution resolution)
    : parameters_(parameters),
      x_(parameters.x, resolution),
      y_(parameters.y, resolution),
      spindle_(parameters.spindle),
      milling_(parameters.tool, parameters.cutting) {
  place(parameters.x.axis.stroke_centre_m, parameters.y.axis.stroke_centre_m);
}

void Machine::place(double x_m, double y_m) noexcept {
  x_.place(x_m);
  y_.place(y_m);
  history_.fill({x_m, y_m});
  signals_.x = x_.signals();
  signals_.y = y_.signals();
}

MillingLoad Machine::cut(const Engagement& engagement, double tick_s) noexcept {
  const double speed = spindle_.speed_rad_per_s();
  if (!engagement.cutting()) return {};
  if (std::abs(speed) < standing_rad_per_s) {
    if (x_.signals().velocity_m_per_s != 0.0 || y_.signals().velocity_m_per_s != 0.0) ++stalled_ticks_;
    return {};
  }
  const double period_s = 2.0 * std::numbers::pi / (milling_.tool().teeth * std::abs(speed));
  double dx_m = x_.signals().velocity_m_per_s * period_s, dy_m = y_.signals().velocity_m_per_s * period_s;
  const double ticks_ago = period_s / tick_s;
  if (parameters_.regenerative && ticks_ago < history_length - 2) {
    const auto whole = static_cast<std::size_t>(ticks_ago);
    const double part = ticks_ago - static_cast<double>(whole);
    const Place& newer = history_[(tick_ - whole) % history_length];
    const Place& older = history_[(tick_ - whole - 1) % history_length];
    dx_m = x_.signals().position_m - (newer.x_m + part * (older.x_m - newer.x_m));
    dy_m = y_.signals().position_m - (newer.y_m + part * (older.y_m - newer.y_m));
  }
  // a tooth meets no more material than lies before it: the force of a spindle that hardly turns would grow without end
  const double feed_m = std::hypot(dx_m, dy_m), most_m = 0.5 * milling_.tool().diameter_m;
  if (feed_m > most_m) {
    ++stalled_ticks_;
    dx_m *= most_m / feed_m;
    dy_m *= most_m / feed_m;
  }
  MillingLoad load = milling_.over(spindle_.angle_rad(), speed * tick_s, dx_m, dy_m, engagement);
  load.removal_rate_m3_per_s = std::max(0.0, load.removal_rate_m3_per_s / period_s);
  return load;
}

const MachineSignals& Machine::step(const MachineCommand& command, double tick_s) noexcept FEEDTWIN_REALTIME {
  history_[tick_ % history_length] = {x_.signals().position_m, y_.signals().position_m};
  const MillingLoad load = cut(command.engagement, tick_s);
  const double x_before_m = x_.signals().position_m, y_before_m = y_.signals().position_m;
  const double spindle_before = spindle_.speed_rad_per_s();

  signals_.x = x_.step({command.torque_x_Nm, -load.force_x_N}, tick_s);
  signals_.y = y_.step({command.torque_y_Nm, -load.force_y_N}, tick_s);
  // against the rotation; run-out with the regenerative chip can give a mean that drives, which the mid-point rule takes too
  const bool finite = std::isfinite(command.spindle_speed_rad_per_s);
  if (!finite) ++clipped_speeds_;
  spindle_.step(finite ? command.spindle_speed_rad_per_s : 0.0, load.torque_Nm, tick_s);

  const auto& auxiliary = parameters_.auxiliary;
  signals_.pump_on = auxiliary.pump_policy == PumpPolicy::always ||
                     (command.pump && (auxiliary.pump_policy == PumpPolicy::commanded || command.engagement.cutting()));
  if (signals_.pump_on) pump_J_ += auxiliary.pump_W * tick_s;

  const double turned = 0.5 * (std::abs(spindle_before) + std::abs(spindle_.speed_rad_per_s())) * tick_s;
  tip_J_ += load.torque_Nm * turned - load.force_x_N * (signals_.x.position_m - x_before_m) -
            load.force_y_N * (signals_.y.position_m - y_before_m);
  removed_m3_ += load.removal_rate_m3_per_s * tick_s;
  time_s_ += tick_s;
  ++tick_;

  const double spindle_J = spindle_.energy().electrical_J + spindle_.energy().shaft_work_J;
  signals_.power_W = signals_.x.power_W + signals_.y.power_W + (spindle_J - last_electrical_J_) / tick_s +
                     auxiliary.controller_W + (signals_.pump_on ? auxiliary.pump_W : 0.0);
  last_electrical_J_ = spindle_J;
  input_J_ += signals_.power_W * tick_s;
  signals_.spindle_speed_rad_per_s = spindle_.speed_rad_per_s();
  signals_.spindle_torque_Nm = spindle_.torque_Nm();
  signals_.cut = load;
  return signals_;
}

MachineEnergy Machine::energy() const noexcept {
  MachineEnergy e;
  e.x = x_.energy();
  e.y = y_.energy();
  e.spindle = spindle_.energy();
  e.pump_J = pump_J_;
  e.controller_J = parameters_.auxiliary.controller_W * time_s_;
  e.tip_J = tip_J_;
  e.removed_m3 = removed_m3_;
  e.input_J = input_J_;
  e.time_s = time_s_;
  return e;
}

}  // namespace feedtwin::plant
