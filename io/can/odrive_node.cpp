#include "io/can/odrive_node.h"

#include <cmath>

namespace feedtwin::io::can {
namespace {

enum Command : int {
  heartbeat = 0x01,
  emergency_stop = 0x02,
  get_error = 0x03,
  set_axis_state = 0x07,
  encoder_estimates = 0x09,
  encoder_count = 0x0A,
  set_controller_mode = 0x0B,
  set_input_torque = 0x0E,
  get_torques = 0x1C,
  clear_errors = 0x18,
};

constexpr std::uint32_t idle = 1, closed_loop_control = 8;  // axis states
constexpr std::uint32_t torque_control = 1;                 // control mode

// Axis errors, as the 0.5 firmware numbers them.
constexpr std::uint32_t invalid_state = 0x1, encoder_error = 0x100, watchdog_expired = 0x800, estop_requested = 0x4000,
                        drive_error = 0x40;

}  // namespace

void OdriveNode::start(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  encoder_.restart(now_ns);
  heartbeat_.restart(now_ns + std::int64_t{settings_.heartbeat_ms} * 1'000'000);
  answer(heartbeat, out);
}

bool OdriveNode::steps_the_plant(const Frame& frame) const noexcept FEEDTWIN_REALTIME {
  return frame.id == (settings_.node_id << 5 | set_input_torque) && !frame.remote;
}

void OdriveNode::accept(const Frame& frame, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  pending_.now_ns = now_ns;
  if (frame.id >> 5 != settings_.node_id) return;
  const int code = frame.id & 0x1F;
  if (frame.remote) {
    answer(code, out);
  } else {
    command(code, frame, now_ns);
  }
}

void OdriveNode::command(int code, const Frame& frame, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME {
  switch (code) {
    case emergency_stop:
      return fail(estop_requested);
    case set_axis_state:
      if (frame.length < 4) break;
      return set_state(load<std::uint32_t>(frame, 0), now_ns);
    case set_controller_mode:
      if (frame.length < 8) break;
      torque_control_ = load<std::uint32_t>(frame, 0) == torque_control;
      pending_.changed = true;
      return;
    case set_input_torque:
      return set_torque(frame, now_ns);
    case clear_errors:
      errors_ = 0;
      pending_.fault_reset = pending_.changed = true;
      return;
    default:
      ++counters_.unknown;
      return;
  }
  ++counters_.refused;  // too short
}

void OdriveNode::set_state(std::uint32_t state, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME {
  pending_.changed = true;
  if (state == closed_loop_control && errors_ == 0) {
    closed_loop_ = true;
    torque_Nm_ = 0.0F;
    pending_.command_ns = now_ns;
  } else if (state == idle) {
    closed_loop_ = false;
  } else {
    fail(invalid_state);
  }
}

void OdriveNode::set_torque(const Frame& frame, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME {
  const float torque_Nm = frame.length >= 4 ? load<float>(frame, 0) : std::nanf("");
  if (!std::isfinite(torque_Nm) || !closed_loop_) {
    ++counters_.refused;
    return;
  }
  ++counters_.commands;
  torque_Nm_ = torque_Nm;
  pending_.command(now_ns);
}

void OdriveNode::fail(std::uint32_t error) noexcept FEEDTWIN_REALTIME {
  errors_ |= error;
  closed_loop_ = false;
  pending_.changed = true;
}

void OdriveNode::answer(int code, FrameQueue& out) const noexcept FEEDTWIN_REALTIME {
  Frame frame;
  frame.id = static_cast<std::uint16_t>(settings_.node_id << 5 | code);
  frame.length = 8;
  const double revolutions = static_cast<double>(axis_.encoder_counts) / settings_.encoder_counts_per_rev;
  const auto counts = static_cast<std::uint32_t>(axis_.encoder_counts);
  switch (code) {
    case heartbeat:
      store(frame, 0, errors_);
      frame.data[4] = static_cast<std::uint8_t>(closed_loop_ ? closed_loop_control : idle);
      break;
    case get_error:
      store(frame, 0, errors_);
      break;
    case encoder_estimates:
      store(frame, 0, static_cast<float>(revolutions));
      store(frame, 4, static_cast<float>(axis_.velocity_m_per_s / settings_.lead_m));
      break;
    case encoder_count: {
      const auto turn = static_cast<std::int64_t>(settings_.encoder_counts_per_rev);
      store(frame, 0, counts);  // wraps every 2^32 counts
      store(frame, 4, static_cast<std::int32_t>(((axis_.encoder_counts % turn) + turn) % turn));
      break;
    }
    case get_torques:
      store(frame, 0, torque_Nm_);
      store(frame, 4, static_cast<float>(axis_.torque_Nm));
      break;
    default:
      return;  // no such message: silence, as on the drive
  }
  out.push(frame);
}

void OdriveNode::report(const AxisReport& axis, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  axis_ = axis;
  pending_.now_ns = now_ns;
  const std::int64_t watchdog_ns = std::int64_t{settings_.watchdog_ms} * 1'000'000;
  if (closed_loop_ && watchdog_ns > 0 && now_ns - pending_.command_ns > watchdog_ns) {
    ++counters_.watchdog;
    fail(watchdog_expired);
  }
  // the plant server's own guard may have taken the torque away
  if (closed_loop_ && axis.state == DriveState::fault && axis.sequence == pending_.sequence) fail(drive_error);
  if (encoder_.due(now_ns, settings_.encoder_ms)) answer(encoder_estimates, out);
  if (heartbeat_.due(now_ns, settings_.heartbeat_ms)) answer(heartbeat, out);
}

bool OdriveNode::take_request(AxisRequest& newest) noexcept FEEDTWIN_REALTIME {
  if (!pending_.take(newest, std::int64_t{settings_.watchdog_ms} * 1'000'000)) return false;
  newest.torque_Nm = closed_loop_ && torque_control_ ? static_cast<double>(torque_Nm_) : 0.0;
  newest.enable = closed_loop_;
  newest.quick_stop = false;
  return true;
}

void OdriveNode::bus_recovered(std::int64_t /*now_ns*/, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  answer(heartbeat, out);
}

void OdriveNode::encoder_failed(std::int64_t /*now_ns*/, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  fail(encoder_error);
  answer(heartbeat, out);
}

void OdriveNode::listens_to(std::span<std::uint16_t, most_ids> ids) const noexcept {
  constexpr std::array<int, 10> served = {
      emergency_stop,      get_error,        set_axis_state, encoder_estimates, encoder_count,
      set_controller_mode, set_input_torque, get_torques,    clear_errors,      heartbeat};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = i < served.size() ? static_cast<std::uint16_t>(settings_.node_id << 5 | served[i]) : 0xFFFF;
  }
}

void OdriveNode::add_counters(const std::string& prefix, std::vector<Counter>& counters) const {
  counters.push_back({prefix + "commands", "torque commands used", counters_.commands, false});
  counters.push_back(
      {prefix + "refused", "commands too short, not finite, or out of closed loop", counters_.refused, false});
  counters.push_back({prefix + "unknown", "frames of a command that is not served", counters_.unknown, false});
  counters.push_back({prefix + "watchdog", "times that commands stayed away for too long", counters_.watchdog, false});
}

}  // namespace feedtwin::io::can
