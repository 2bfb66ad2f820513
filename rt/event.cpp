#include "rt/event.h"

namespace feedtwin::rt {

std::string_view meaning(EventKind kind) noexcept {
  switch (kind) {
    case EventKind::enabled:
      return "drive enabled";
    case EventKind::disabled:
      return "drive disabled by the controller";
    case EventKind::quick_stop:
      return "quick stop: the drive brakes";
    case EventKind::watchdog:
      return "watchdog: no new command for {:.1f} ms, torque to zero";
    case EventKind::fault_cleared:
      return "fault cleared";
    case EventKind::refused_number:
      return "command refused: not a finite number";
    case EventKind::torque_clipped:
      return "torque command of {:.4f} N m clipped to the drive's limit";
    case EventKind::end_stop:
      return "table runs into an end stop at {:.4f} m/s";
    case EventKind::missed_ticks:
      return "{:.0f} ticks missed";
    case EventKind::late_tick:
      return "tick began {:.0f} us late";
  }
  return "";
}

}  // namespace feedtwin::rt
