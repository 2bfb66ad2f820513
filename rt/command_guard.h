#pragma once
// From a controller's request to the torque that acts: age, sequence, finite, limits; a watchdog to zero torque.

#include <cstdint>
#include <optional>

#include "io/port.h"
#include "plant/realtime.h"
#include "rt/event.h"

namespace feedtwin::rt {

/// A jump of the sequence by more than this is a controller that has started afresh, not lost or old requests.
inline constexpr std::int32_t restart_distance = 1000;

struct GuardLimits {
  double torque_limit_Nm = 1.9;
  std::int64_t watchdog_ns = 100'000'000;  ///< a request that old is a fault, unless it names a time of its own
};

struct GuardCounters {
  std::uint64_t held = 0;       ///< ticks without a new request: the last one was held
  std::uint64_t repeated = 0;   ///< requests with the sequence of the one before
  std::uint64_t lost = 0;       ///< sequence numbers that never came
  std::uint64_t reordered = 0;  ///< requests older than one already used: not used
  std::uint64_t refused = 0;    ///< not finite: not used
  std::uint64_t clipped = 0;    ///< beyond the torque limit
  std::uint64_t watchdog = 0;   ///< times that the watchdog took the torque away
};

/// One axis's guard.
///
/// disabled -> enabled on a request with `enable`; enabled -> quick_stop on `quick_stop`, back when it is taken away;
/// enabled, quick_stop -> fault when the newest request is older than the watchdog time; fault -> disabled when a new
/// request raises `fault_reset` or takes `enable` away and gives it again, or when a controller that has started afresh
/// gives it at once. The controller's torque acts in `enabled` only; in `quick_stop`
/// the drive brakes (quick_stop.h).
class CommandGuard {
 public:
  explicit CommandGuard(const GuardLimits& limits) noexcept : limits_(limits) {}

  struct Decision {
    double torque_Nm = 0.0;
    std::int64_t age_ns = -1;  ///< of the request in force; negative: none has come yet
    std::optional<EventKind> event;
    double event_value = 0.0;
  };

  /// Once a tick. @param fresh a new request came in this tick. Wait-free.
  [[nodiscard]] Decision decide(const io::AxisRequest& request, bool fresh, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] io::DriveState state() const noexcept { return state_; }
  [[nodiscard]] const io::AxisRequest& in_force() const noexcept FEEDTWIN_REALTIME { return in_force_; }
  [[nodiscard]] std::uint32_t sequence() const noexcept { return in_force_.sequence; }
  [[nodiscard]] const GuardCounters& counters() const noexcept { return counters_; }

 private:
  /// @param before what a rising edge is told against; cleared for a controller that has started afresh
  bool take(const io::AxisRequest& request, io::AxisRequest& before, Decision& decision) noexcept FEEDTWIN_REALTIME;
  void change_state(const io::AxisRequest& before, bool fresh, Decision& decision) noexcept FEEDTWIN_REALTIME;

  GuardLimits limits_;
  GuardCounters counters_;
  io::AxisRequest in_force_;
  bool any_request_ = false;
  io::DriveState state_ = io::DriveState::disabled;
};

}  // namespace feedtwin::rt
