#include "rt/command_guard.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::rt {

using io::DriveState;

bool CommandGuard::take(const io::AxisRequest& request, io::AxisRequest& before, Decision& decision) noexcept {
  if (!std::isfinite(request.torque_Nm)) {
    ++counters_.refused;
    decision.event = EventKind::refused_number;
    return false;
  }
  if (any_request_) {
    // distance on the ring of sequence numbers: 0 repeated, negative older, above 1 some were lost
    const auto ahead = static_cast<std::int32_t>(request.sequence - in_force_.sequence);
    if (ahead == 0 && request.counted) ++counters_.repeated;
    if (ahead < 0 && ahead > -restart_distance) {
      ++counters_.reordered;
      return false;
    }
    if (ahead >= restart_distance || ahead <= -restart_distance) before = {};
    if (ahead > 0 && ahead < restart_distance)
      counters_.lost += static_cast<std::uint64_t>(std::max<std::int64_t>(0, std::int64_t{ahead} - 1 - request.superseded));
  }
  in_force_ = request;
  any_request_ = true;
  return true;
}

void CommandGuard::change_state(const io::AxisRequest& before, bool fresh, Decision& decision) noexcept {
  const DriveState old = state_;
  const std::int64_t watchdog_ns = in_force_.watchdog_ns > 0 ? in_force_.watchdog_ns : limits_.watchdog_ns;
  const bool live = any_request_ && decision.age_ns <= watchdog_ns;
  const bool reset = fresh && ((in_force_.fault_reset && !before.fault_reset) || (in_force_.enable && !before.enable));
  switch (state_) {
    case DriveState::fault:
      if (reset && live) state_ = DriveState::disabled;
      break;
    case DriveState::disabled:
      if (live && in_force_.enable && !in_force_.quick_stop) state_ = DriveState::enabled;
      break;
    case DriveState::enabled:
    case DriveState::quick_stop:
      if (!live) {
        state_ = DriveState::fault;
        ++counters_.watchdog;
      } else if (!in_force_.enable) {
        state_ = DriveState::disabled;
      } else {
        state_ = in_force_.quick_stop ? DriveState::quick_stop : DriveState::enabled;
      }
      break;
  }
  if (state_ == old) return;
  switch (state_) {
    case DriveState::fault:
      decision.event = EventKind::watchdog;
      decision.event_value = static_cast<double>(decision.age_ns) * 1e-6;
      break;
    case DriveState::disabled:
      decision.event = old == DriveState::fault ? EventKind::fault_cleared : EventKind::disabled;
      break;
    case DriveState::enabled:
      decision.event = EventKind::enabled;
      break;
    case DriveState::quick_stop:
      decision.event = EventKind::quick_stop;
      break;
  }
}

CommandGuard::Decision CommandGuard::decide(const io::AxisRequest& request, bool fresh, std::int64_t now_ns) noexcept {
  Decision decision;
  io::AxisRequest before = in_force_;
  const bool taken = fresh && take(request, before, decision);
  if (!fresh && any_request_) ++counters_.held;
  if (any_request_) decision.age_ns = std::max<std::int64_t>(0, now_ns - in_force_.arrival_ns);
  change_state(before, taken, decision);
  if (state_ != DriveState::enabled) return decision;
  decision.torque_Nm = std::clamp(in_force_.torque_Nm, -limits_.torque_limit_Nm, limits_.torque_limit_Nm);
  if (decision.torque_Nm != in_force_.torque_Nm) {
    ++counters_.clipped;
    if (taken && !decision.event && std::abs(before.torque_Nm) <= limits_.torque_limit_Nm) {
      decision.event = EventKind::torque_clipped;
      decision.event_value = in_force_.torque_Nm;
    }
  }
  return decision;
}

}  // namespace feedtwin::rt
