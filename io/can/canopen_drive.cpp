// The drive side of the node: CiA 402 states, torque, and what happens when commands stay away.

#include <algorithm>

#include "io/can/canopen_node.h"
#include "io/drive_words.h"

namespace feedtwin::io::can {
namespace {

constexpr int cyclic_synchronous_torque = 10;
/// 605A, quick stop option code: the two that know no ramp.
enum QuickStopOption : int { at_the_limit = 3, at_the_limit_and_stay = 7 };
/// 6007, abort connection option code.
enum AbortConnection : int { no_action = 0, to_fault = 1, disable_voltage = 2, to_quick_stop = 3 };

}  // namespace

StopOptions CanopenNode::stop_options() const noexcept FEEDTWIN_REALTIME {
  return {static_cast<int>(at(entry_.quick_stop_option)), static_cast<int>(at(entry_.fault_option))};
}

void CanopenNode::step_drive(FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  const auto before = drive_state_.state();
  const auto controlword = static_cast<std::uint16_t>(at(entry_.controlword));
  if (drive_state_.step(controlword, standstill_, stop_options())) {
    pending_.fault_reset = true;
    emergency_.clear(objects_, out);
  }
  if (drive_state_.state() != before) {
    pending_.changed = true;
    syncs_without_command_ = 0;
  }
  show_status();
}

void CanopenNode::fault(ErrorCode code, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  emergency_.raise(code, objects_, out);
  drive_state_.fault(stop_options());
  pending_.changed = true;
  show_status();
}

void CanopenNode::command_lost(ErrorCode code, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  ++counters_.command_losses;
  syncs_without_command_ = 0;
  pending_.changed = true;
  switch (static_cast<int>(at(entry_.abort_option))) {
    case to_fault:
      fault(code, out);
      return;
    case disable_voltage:
      drive_state_.disable();
      break;
    case to_quick_stop:
      drive_state_.quick_stop();
      break;
    default:
      break;
  }
  // A controlword that is still standing must not switch the drive on again by itself.
  if (at(entry_.abort_option) != no_action) objects_.set(entry_.controlword, 0x02 & at(entry_.controlword));
  emergency_.raise(code, objects_, out);
  show_status();
}

void CanopenNode::show_status() noexcept FEEDTWIN_REALTIME {
  std::uint16_t word = drive_state_.status_bits() | status::voltage_enabled;
  if (nmt_ == NmtState::operational) word |= status::remote;
  if (torque_limited_ || axis_.at_low_stop || axis_.at_high_stop) word |= status::internal_limit;
  if (drive_state_.operating() && at(entry_.mode_shown) == cyclic_synchronous_torque) word |= status::follows_command;
  objects_.set(entry_.statusword, word);
}

double CanopenNode::wanted_torque_Nm() noexcept FEEDTWIN_REALTIME {
  if (!drive_state_.operating() || at(entry_.mode_shown) != cyclic_synchronous_torque) {
    torque_limited_ = false;
    objects_.set(entry_.torque_demand, 0);
    return 0.0;
  }
  const auto wanted = at(entry_.target_torque) + at(entry_.torque_offset);
  const auto most = at(entry_.most_torque);
  const auto used = std::clamp(wanted, -most, most);
  torque_limited_ = used != wanted;
  objects_.set(entry_.torque_demand, used);
  return static_cast<double>(used) * 1e-3 * drive_.rated_torque_Nm;
}

bool CanopenNode::take_request(AxisRequest& newest) noexcept FEEDTWIN_REALTIME {
  if (!pending_.take(newest, at(entry_.sync_timeout) * 1'000'000)) return false;
  newest.torque_Nm = wanted_torque_Nm();
  newest.enable = drive_state_.operating() || drive_state_.braking();
  newest.quick_stop = drive_state_.braking();
  const int option = stop_options().quick_stop;
  const bool ramp = option != at_the_limit && option != at_the_limit_and_stay;
  newest.brake_m_per_s2 =
      ramp ? static_cast<double>(at(entry_.deceleration)) * drive_.lead_m / drive_.encoder_counts_per_rev : 0.0;
  newest.brake_limit_Nm = static_cast<double>(at(entry_.most_torque)) * 1e-3 * drive_.rated_torque_Nm;
  return true;
}

bool CanopenNode::take_machine_request(MachineRequest& newest) noexcept FEEDTWIN_REALTIME {
  if (!machine_changed_) return false;
  machine_changed_ = false;
  newest = machine_request(rad_per_s_per_rpm * static_cast<double>(at(entry_.spindle_speed)),
                           static_cast<unsigned>(at(entry_.auxiliary)), 1e-6 * static_cast<double>(at(entry_.depth_of_cut)));
  return true;
}

}  // namespace feedtwin::io::can
