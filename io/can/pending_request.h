#pragma once
// What a drive on the bus has to tell the plant at its next tick, and when its newest command came.

#include <cstdint>

#include "io/port.h"
#include "plant/realtime.h"

namespace feedtwin::io::can {

struct PendingRequest {
  bool changed = false;        ///< there is something to tell
  bool fresh_command = false;  ///< it is a command; otherwise it is the drive's own doing
  bool fault_reset = false;    ///< to pass on
  std::uint32_t sequence = 0;
  std::int64_t now_ns = 0;      ///< of the call under way
  std::int64_t command_ns = 0;  ///< arrival of the newest command

  void command(std::int64_t arrival_ns) noexcept FEEDTWIN_REALTIME {
    command_ns = arrival_ns;
    changed = fresh_command = true;
  }
  /// Everything of the request but the torque and the drive's state. @return false if there is nothing to tell.
  /// @param timeout_ns the drive's own supervision, 0 for none: that is to act first, so that the drive says what was
  /// missing
  bool take(AxisRequest& newest, std::int64_t timeout_ns) noexcept FEEDTWIN_REALTIME {
    constexpr std::int64_t guard_margin_ns = 50'000'000;
    if (!changed) return false;
    newest.sequence = ++sequence;
    newest.arrival_ns = fresh_command ? command_ns : now_ns;
    newest.fault_reset = fault_reset;
    newest.watchdog_ns = timeout_ns > 0 ? timeout_ns + guard_margin_ns : 0;
    changed = fresh_command = fault_reset = false;
    return true;
  }
};

}  // namespace feedtwin::io::can
