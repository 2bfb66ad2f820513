#pragma once
// How a controller reaches the plant, whatever the wire. One interface for every port; the loop knows nothing else.
//
// Set-up calls may block, allocate and throw PortError. receive() and send() run inside the tick: wait-free, bounded, no
// system call that may block. What goes wrong at run time is a counter with a one-line meaning, never an exception.

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "plant/machine/engagement.h"
#include "plant/realtime.h"

namespace feedtwin::io {

inline constexpr int max_axes = 64;

/// The newest torque request for one axis.
struct AxisRequest {
  double torque_Nm = 0.0;
  std::uint32_t sequence = 0;    ///< the controller's count of its own commands
  bool counted = true;           ///< false: the controller does not count, and the sequence says nothing
  std::int64_t arrival_ns = 0;   ///< CLOCK_MONOTONIC, when it came off the wire
  std::int64_t watchdog_ns = 0;  ///< the controller's own watchdog time; 0: the configuration's
  bool enable = false;
  bool quick_stop = false;
  double brake_m_per_s2 = 0.0;   ///< in a quick stop: slow down along this ramp; 0: as fast as the torque brakes
  double brake_limit_Nm = -1.0;  ///< in a quick stop: the most torque; negative: rated torque
  bool fault_reset = false;      ///< a rising edge clears a watchdog fault
  std::uint32_t superseded = 0;  ///< requests that came since the last tick and that this one replaced
  std::int64_t reply_ns = -1;  ///< from the controller's trigger (SYNC, poll) to the reply's leaving; negative: not measured
};

/// `newer` replaces `older` before any tick has seen that one: what acts by a change alone must not get lost.
[[nodiscard]] inline AxisRequest replacing(const AxisRequest& older, AxisRequest newer) noexcept FEEDTWIN_REALTIME {
  newer.fault_reset = newer.fault_reset || older.fault_reset || (newer.enable && !older.enable);
  newer.superseded = older.superseded + 1;
  return newer;
}

/// What the controller of a whole machine tool wants beside the torques of its axes. It acts while an axis is enabled and
/// none is in fault.
struct MachineRequest {
  double spindle_speed_rad_per_s = 0.0;  ///< S with M3; negative with M4; 0 with M5
  bool pump = false;                     ///< M7, M8; off with M9
  double depth_of_cut_m = 0.0;           ///< of a slot as wide as the cutter, where the tool stands over the block
  bool path_engagement = false;          ///< the controller knows its path, and `engagement` is what it meets there
  plant::Engagement engagement{};
};

/// What the loop makes of an axis's requests (rt/command_guard), in the order of increasing alarm.
enum class DriveState : std::uint8_t { disabled, enabled, quick_stop, fault };

/// One axis at the end of a tick.
struct AxisReport {
  std::uint64_t ticks_done = 0;  ///< when it was so; a recording's row of this number begins with it
  std::int64_t encoder_counts = 0;
  double velocity_m_per_s = 0.0;
  double torque_Nm = 0.0;
  std::int64_t input_age_ns = 0;  ///< from arrival to use; negative: nothing has come yet
  std::uint32_t sequence = 0;     ///< of the request in force
  DriveState state = DriveState::disabled;
  bool index_passed = false;
  bool at_low_stop = false, at_high_stop = false;
};

struct TickReport {
  std::uint64_t tick = 0;
  std::uint64_t missed_ticks = 0;
  std::int64_t start_ns = 0;  ///< CLOCK_MONOTONIC
};

/// Something that was counted, for the run's verdict.
struct Counter {
  std::string name, meaning;
  std::uint64_t value = 0;
  bool loses_data = false;  ///< more than zero: the run is not sound
};

/// What can be broken on purpose in an axis's encoder (io/faults).
enum class EncoderFault : std::uint8_t { dead_a, dead_b, dead_index, swapped_ab, lost_counts, missing_index };

/// Something that happened in a port and that somebody should read of.
struct PortEvent {
  double time_s = 0.0;  ///< of the run: tick number times tick length
  std::string text;
};

/// Set-up went wrong: one line for the user.
class PortError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// Set-up: open devices, start threads. Throws PortError.
  virtual void open() = 0;
  /// Before the end: stop threads, close devices. Safe to call twice.
  virtual void close() noexcept = 0;

  /// Drain what has come, at most a bounded number of frames, and keep the newest request of each axis.
  /// @return a bit for each axis that has a new one.
  virtual std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME = 0;
  /// The newest request for the machine that the axes belong to. Wait-free.
  /// @return false if nothing has changed, or if this port has none: `newest` stays as it is.
  virtual bool receive_machine(MachineRequest& /*newest*/) noexcept FEEDTWIN_REALTIME { return false; }
  /// Give out the tick's result.
  virtual void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME = 0;

  /// Lockstep only: wait until a request has come or the time has passed. @return false on time-out, or if this port can't
  /// step the plant.
  virtual bool wait_for_request(std::int64_t /*until_ns*/) noexcept { return false; }
  [[nodiscard]] virtual bool can_step_the_plant() const noexcept { return false; }

  /// Break the encoder of an axis on its own lines, or mend it. `amount`: counts to lose. Wait-free.
  /// @return false if this port has no lines; the fault is then worked into the counts that it is given.
  virtual bool break_encoder(EncoderFault /*fault*/, int /*axis*/, bool /*on*/,
                             std::int64_t /*amount*/) noexcept FEEDTWIN_REALTIME {
    return false;
  }

  /// Not on the tick.
  [[nodiscard]] virtual std::vector<Counter> counters() const { return {}; }
  /// What has happened since the last call. Not on the tick, from one thread at a time.
  [[nodiscard]] virtual std::vector<PortEvent> take_events() { return {}; }
};

}  // namespace feedtwin::io
