#pragma once
// The whole machine tool of the source's section 4: XY table of two feed axes, spindle, lubricant pump, controller, and the
// cut that couples them. Positions are the tool's against the workpiece, so the cutting force on the tool is the force on
// the axis.

#include <array>
#include <cstdint>

#include "plant/feed_axis.h"
#include "plant/machine/engagement.h"
#include "plant/machine/milling_force.h"
#include "plant/machine/spindle.h"
#include "plant/realtime.h"

namespace feedtwin::plant {

/// When the lubricant pump draws its power.
enum class PumpPolicy {
  commanded,  ///< M7 or M8 on, M9 off
  always,     ///< as long as the machine is on
  cutting,    ///< commanded, and the tool is in material
};

struct AuxiliaryParameters {
  double pump_W = 10.0;        ///< the source's section 4
  double controller_W = 15.0;  ///< likewise; as long as the machine is on
  PumpPolicy pump_policy = PumpPolicy::commanded;
};

struct MachineParameters {
  AxisParameters x, y;
  SpindleParameters spindle;
  AuxiliaryParameters auxiliary;
  ToolParameters tool;
  CuttingCoefficients cutting;
  bool regenerative = false;  ///< chip thickness from where the table really was a tooth period ago
};

/// Into the machine, held for one tick.
struct MachineCommand {
  double torque_x_Nm = 0.0, torque_y_Nm = 0.0;
  double spindle_speed_rad_per_s = 0.0;  ///< positive clockwise (M3), negative counterclockwise (M4)
  bool pump = false;                     ///< M7, M8
  Engagement engagement{};               ///< where the cutter meets material
};

/// Out of the machine at the end of a tick.
struct MachineSignals {
  AxisSignals x, y;
  double spindle_speed_rad_per_s = 0.0, spindle_torque_Nm = 0.0;
  MillingLoad cut;       ///< removal rate per second
  double power_W = 0.0;  ///< electrical input of the whole machine, mean over the tick
  bool pump_on = false;
};

/// Since the start, J.
struct MachineEnergy {
  AxisEnergy x, y;
  SpindleEnergy spindle;
  double pump_J = 0.0, controller_J = 0.0;
  double tip_J = 0.0;  ///< work at the cutting edges, from force and motion there: the check of the components' shares
  double removed_m3 = 0.0;
  double input_J = 0.0;  ///< electrical, summed tick by tick from the power
  double time_s = 0.0;

  [[nodiscard]] double auxiliary_J() const noexcept { return pump_J + controller_J; }
  [[nodiscard]] double spindle_J() const noexcept FEEDTWIN_REALTIME { return spindle.electrical_J + spindle.shaft_work_J; }
  [[nodiscard]] double feed_J() const noexcept FEEDTWIN_REALTIME {
    return x.motor_electrical_J + x.input_work_J + y.motor_electrical_J + y.input_work_J;
  }
  [[nodiscard]] double total_J() const noexcept { return auxiliary_J() + spindle_J() + feed_J(); }
  /// |input - what the components took| / input. Cutting is taken from the tool's tip, not from the components.
  [[nodiscard]] double balance_error() const noexcept;
};

/// Mean power by component over a time, W. Mechanical and cutting shares are work done, electrical shares are loss.
struct ComponentPower {
  double pump_W = 0.0, controller_W = 0.0, spindle_W = 0.0, feed_W = 0.0;
  [[nodiscard]] double total_W() const noexcept { return pump_W + controller_W + spindle_W + feed_W; }
  /// Of the servo system (feed drives and spindle) in the total: the source's Fig. 8.
  [[nodiscard]] double servo_share() const noexcept { return (spindle_W + feed_W) / total_W(); }
};

/// Between two instants; nothing where no time has passed. Wait-free.
[[nodiscard]] ComponentPower mean_power(const MachineEnergy& from, const MachineEnergy& to) noexcept FEEDTWIN_REALTIME;

class Machine {
 public:
  explicit Machine(const MachineParameters& parameters, Resolution resolution = one_count);

  /// Advance by one tick. Wait-free.
  const MachineSignals& step(const MachineCommand& command, double tick_s) noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] const MachineSignals& signals() const noexcept FEEDTWIN_REALTIME { return signals_; }
  [[nodiscard]] const FeedAxis& x() const noexcept FEEDTWIN_REALTIME { return x_; }
  [[nodiscard]] const FeedAxis& y() const noexcept FEEDTWIN_REALTIME { return y_; }
  [[nodiscard]] const MachineParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] MachineEnergy energy() const noexcept FEEDTWIN_REALTIME;
  /// Ticks in which the tool was pushed into material with the spindle standing (there is no force model for that), or so
  /// slow that a tooth would take more than the cutter's radius (the force is that of the radius then).
  [[nodiscard]] std::int64_t stalled_ticks() const noexcept { return stalled_ticks_; }

  /// Inputs that were not finite or beyond a limit, of both axes and the spindle's speed.
  [[nodiscard]] std::int64_t clipped_inputs() const noexcept {
    return x_.clipped_inputs() + y_.clipped_inputs() + clipped_speeds_;
  }

  /// Put the table somewhere, at rest. Set-up only.
  void place(double x_m, double y_m) noexcept;

 private:
  [[nodiscard]] MillingLoad cut(const Engagement& engagement, double tick_s) noexcept;

  MachineParameters parameters_;
  FeedAxis x_, y_;
  Spindle spindle_;
  MillingForce milling_;
  MachineSignals signals_;
  double pump_J_ = 0.0, tip_J_ = 0.0, removed_m3_ = 0.0, input_J_ = 0.0, time_s_ = 0.0;
  double last_electrical_J_ = 0.0;
  std::int64_t stalled_ticks_ = 0, clipped_speeds_ = 0;

  struct Place {
    double x_m, y_m;
  };
  static constexpr std::size_t history_length = 512;  // ticks: a tooth period that regeneration can look back over
  std::array<Place, history_length> history_{};
  std::size_t tick_ = 0;
};

}  // namespace feedtwin::plant
