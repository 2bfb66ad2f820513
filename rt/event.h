#pragma once
// What happened in a tick that somebody should read of. The tick hands it over; a thread outside writes it down.

#include <cstdint>
#include <string_view>

namespace feedtwin::rt {

enum class EventKind : std::uint8_t {
  enabled,
  disabled,
  quick_stop,
  watchdog,  ///< the command grew too old: torque to zero
  fault_cleared,
  refused_number,  ///< a command that is not a finite number
  torque_clipped,
  end_stop,
  missed_ticks,
  late_tick,
};

[[nodiscard]] std::string_view meaning(EventKind kind) noexcept;

struct Event {
  std::uint64_t tick = 0;
  EventKind kind{};
  std::int32_t axis = -1;  ///< -1: none
  double value = 0.0;      ///< in the kind's own unit: us for times, N m for torque, ticks for counts
};

}  // namespace feedtwin::rt
