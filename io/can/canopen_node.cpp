// The network side of the node: NMT, SYNC, PDOs, heartbeat, supervision.

#include "io/can/canopen_node.h"
#include "io/can/identifiers.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::io::can {
namespace {

enum NmtCommand : std::uint8_t {
  start_node = 0x01,
  stop_node = 0x02,
  to_pre_operational = 0x80,
  reset_node = 0x81,
  reset_communication = 0x82
};

/// An axis slower than this stands still: one count in ten ticks of 1 ms.
constexpr double standstill_counts_per_s = 100.0;

constexpr bool acyclic(int type) noexcept FEEDTWIN_REALTIME {
  return type >= 254;
}

}  // namespace

CanopenNode::CanopenNode(const DriveIdentity& drive)
    : drive_(drive),
      entry_{entry_of(0x6040, 0), entry_of(0x6041, 0), entry_of(0x6060, 0), entry_of(0x6061, 0), entry_of(0x6071, 0),
             entry_of(0x6072, 0), entry_of(0x60B2, 0), entry_of(0x6074, 0), entry_of(0x6077, 0), entry_of(0x6064, 0),
             entry_of(0x606C, 0), entry_of(0x60FD, 0), entry_of(0x605A, 0), entry_of(0x605E, 0), entry_of(0x6007, 0),
             entry_of(0x2001, 0), entry_of(0x2002, 0), entry_of(0x1017, 0), entry_of(0x1016, 1), entry_of(0x2010, 0),
             entry_of(0x2011, 0), entry_of(0x2012, 0), entry_of(0x6085, 0), entry_of(0x2004, 0)},
      objects_(drive) {
  for (int i = 0; i < pdos; ++i) {
    const auto n = static_cast<std::size_t>(i);
    rpdo_[n].communication = entry_of(static_cast<std::uint16_t>(0x1400 + i), 0);
    rpdo_[n].map = entry_of(static_cast<std::uint16_t>(0x1600 + i), 0);
    tpdo_[n].communication = entry_of(static_cast<std::uint16_t>(0x1800 + i), 0);
    tpdo_[n].map = entry_of(static_cast<std::uint16_t>(0x1A00 + i), 0);
  }
  configure_all();
  show_status();
}

void CanopenNode::start(std::int64_t /*now_ns*/, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  boot(out);
}

void CanopenNode::boot(FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  Frame frame;
  frame.id = static_cast<std::uint16_t>(heartbeat_id + drive_.node_id);
  frame.length = 1;  // 00: boot-up
  out.push(frame);
  nmt_ = NmtState::pre_operational;
  heartbeat_.restart();
}

void CanopenNode::send_state(FrameQueue& out) const noexcept FEEDTWIN_REALTIME {
  Frame frame;
  frame.id = static_cast<std::uint16_t>(heartbeat_id + drive_.node_id);
  frame.length = 1;
  frame.data[0] = static_cast<std::uint8_t>(nmt_);
  out.push(frame);
}

void CanopenNode::accept(const Frame& frame, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  pending_.now_ns = now_ns;
  if (frame.id == nmt_id) return network_command(frame, now_ns, out);
  if (frame.id == sync_id) return sync(now_ns, out);
  if (frame.id == sdo_request_id + drive_.node_id) {
    Frame reply;
    reply.id = static_cast<std::uint16_t>(sdo_reply_id + drive_.node_id);
    if (nmt_ != NmtState::stopped && sdo_.answer(frame, now_ns, *this, reply)) out.push(reply);
    step_drive(out);
    return;
  }
  const auto consumer = static_cast<std::uint32_t>(at(entry_.heartbeat_consumer));
  if (frame.id == heartbeat_id + (consumer >> 16 & 0x7FU) && frame.length == 1 && (consumer & 0xFFFFU) != 0) {
    return master_.seen(now_ns);
  }
  for (auto& pdo : rpdo_) {
    if (pdo.exists && pdo.cob_id == frame.id) receive_pdo(pdo, frame, now_ns, out);
  }
}

void CanopenNode::network_command(const Frame& frame, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  if (frame.length < 2 || frame.remote || (frame.data[1] != 0 && frame.data[1] != drive_.node_id)) return;
  const auto leave_operation = [&](NmtState next) {
    if (nmt_ == NmtState::operational && drive_state_.operating()) command_lost(ErrorCode::communication, out);
    nmt_ = next;
  };
  switch (frame.data[0]) {
    case start_node:
      if (nmt_ != NmtState::operational) {
        for (auto& pdo : rpdo_) pdo.pending = false;
        // the nodes' slow PDOs fall on different SYNCs, so that no cycle has to carry them all
        for (auto& pdo : tpdo_) pdo.sent = false, pdo.syncs = drive_.node_id % std::max(pdo.type, 1);
        syncs_without_command_ = 0;
        supervised_since_ns_ = now_ns;
      }
      nmt_ = NmtState::operational;
      break;
    case stop_node:
      leave_operation(NmtState::stopped);
      break;
    case to_pre_operational:
      leave_operation(NmtState::pre_operational);
      break;
    case reset_node:
      reset_application();
      boot(out);
      break;
    case reset_communication:
      leave_operation(NmtState::pre_operational);
      objects_.reset(drive_, 0x1000, 0x1FFF);
      configure_all();
      sdo_.reset();
      master_.disarm();
      boot(out);
      break;
    default:
      break;
  }
  show_status();
}

void CanopenNode::reset_application() noexcept FEEDTWIN_REALTIME {
  drive_state_.reset();
  objects_.reset(drive_);
  configure_all();
  sdo_.reset();
  master_.disarm();
  pending_.changed = machine_changed_ = true;
}

void CanopenNode::receive_pdo(Pdo& pdo, const Frame& frame, std::int64_t now_ns,
                              FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  if (nmt_ != NmtState::operational) {
    ++counters_.not_operational;
    return;
  }
  if (frame.remote || frame.length < pdo.mapping.bytes) {
    ++counters_.wrong_length;
    if (!frame.remote) emergency_.raise(ErrorCode::pdo_length, objects_, out);
    return;
  }
  if (pdo.pending) ++counters_.superseded;
  pdo.frame = frame;
  pdo.time_ns = now_ns;
  pdo.pending = true;
  if (acyclic(pdo.type)) use(pdo, out);
}

/// @return true if there was a frame and it carried a command.
bool CanopenNode::use(Pdo& pdo, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  if (!pdo.pending) return false;
  pdo.pending = false;
  ++counters_.commands;
  const bool command = pdo.mapping.carries(entry_.controlword) || pdo.mapping.carries(entry_.target_torque);
  if (command) {
    pending_.command(pdo.time_ns);
  }
  unpack(pdo.mapping, pdo.frame, [&](int entry, std::int64_t value) FEEDTWIN_REALTIME { take(entry, value, out); });
  return command;
}

void CanopenNode::take(int entry, std::int64_t value, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  const auto& object = object_table()[static_cast<std::size_t>(entry)];
  if (value < object.lowest || value > object.highest || allow(entry, value) != Abort::ok) {
    ++counters_.refused_values;
    return;
  }
  objects_.set(entry, value);
  written(entry);
  if (entry == entry_.controlword) step_drive(out);
}

void CanopenNode::sync(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  ++counters_.syncs;
  if (nmt_ != NmtState::operational) return;
  bool command = false, expected = false;
  for (auto& pdo : rpdo_) {
    if (!pdo.exists || acyclic(pdo.type)) continue;
    expected = expected || pdo.mapping.carries(entry_.controlword) || pdo.mapping.carries(entry_.target_torque);
    command = use(pdo, out) || command;
  }
  step_drive(out);
  syncs_without_command_ = command || !expected ? 0 : syncs_without_command_ + 1;
  if (drive_state_.operating() && syncs_without_command_ > at(entry_.most_missed_syncs)) {
    command_lost(ErrorCode::rpdo_timeout, out);
  }
  for (auto& pdo : tpdo_) {
    if (!pdo.exists || acyclic(pdo.type)) continue;
    if (++pdo.syncs < std::max(pdo.type, 1)) continue;
    pdo.syncs = 0;
    transmit(pdo, now_ns, out);
  }
}

void CanopenNode::transmit(Pdo& pdo, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  Frame frame;
  frame.id = pdo.cob_id;
  pack(pdo.mapping, objects_, frame);
  if (pdo.type == 0 && pdo.sent && frame == pdo.frame) return;  // type 0: at SYNC, but only news
  pdo.frame = frame;
  pdo.sent = true;
  pdo.time_ns = now_ns;
  out.push(frame);
}

void CanopenNode::report(const AxisReport& axis, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  axis_ = axis;
  pending_.now_ns = now_ns;
  const double counts_per_m = drive_.encoder_counts_per_rev / drive_.lead_m;
  const double velocity = std::clamp(axis.velocity_m_per_s * counts_per_m, -2147483648.0, 2147483647.0);
  const double wanted_per_mille = std::nearbyint(axis.torque_Nm / drive_.rated_torque_Nm * 1e3);
  const double per_mille = std::clamp(wanted_per_mille, -32768.0, 32767.0);
  if (per_mille != wanted_per_mille) ++counters_.saturated;
  standstill_ = std::abs(velocity) < standstill_counts_per_s;
  objects_.set(entry_.ticks, static_cast<std::uint32_t>(axis.ticks_done));
  objects_.set(entry_.position, static_cast<std::int32_t>(static_cast<std::uint32_t>(axis.encoder_counts)));
  objects_.set(entry_.velocity, static_cast<std::int64_t>(velocity));
  objects_.set(entry_.torque, static_cast<std::int64_t>(per_mille));
  objects_.set(entry_.inputs, (axis.at_low_stop ? 1 : 0) | (axis.at_high_stop ? 2 : 0) | (axis.index_passed ? 4 : 0));
  // the plant server's own guard may have taken the torque away
  if (axis.state == DriveState::fault && axis.sequence == pending_.sequence && drive_state_.operating())
    fault(ErrorCode::guard, out);
  step_drive(out);
  supervise(now_ns, out);
  if (heartbeat_.due(now_ns, at(entry_.heartbeat_producer))) send_state(out);
  if (nmt_ != NmtState::operational) return;
  const auto statusword = static_cast<std::uint16_t>(at(entry_.statusword));
  for (auto& pdo : tpdo_) {
    if (!pdo.exists || !acyclic(pdo.type)) continue;
    const std::int64_t timer_ns = at(pdo.communication + 3) * 1'000'000;
    const bool news = pdo.mapping.carries(entry_.statusword) && statusword != last_statusword_;
    if (!pdo.sent || news || (timer_ns > 0 && now_ns - pdo.time_ns >= timer_ns)) transmit(pdo, now_ns, out);
  }
  last_statusword_ = statusword;
}

void CanopenNode::supervise(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  if (master_.lost(now_ns, at(entry_.heartbeat_consumer) & 0xFFFF)) {
    if (drive_state_.operating()) {
      command_lost(ErrorCode::heartbeat, out);
    } else {
      emergency_.raise(ErrorCode::heartbeat, objects_, out);
    }
  }
  const std::int64_t timeout_ns = at(entry_.sync_timeout) * 1'000'000;
  const std::int64_t since_ns = std::max(pending_.command_ns, supervised_since_ns_);
  if (timeout_ns > 0 && drive_state_.operating() && now_ns - since_ns > timeout_ns)
    command_lost(ErrorCode::rpdo_timeout, out);
}

void CanopenNode::bus_recovered(std::int64_t /*now_ns*/, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  if (drive_state_.operating()) {
    command_lost(ErrorCode::bus_off_recovered, out);
  } else {
    emergency_.raise(ErrorCode::bus_off_recovered, objects_, out);
  }
}

void CanopenNode::encoder_failed(std::int64_t /*now_ns*/, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  fault(ErrorCode::encoder, out);
}

bool CanopenNode::steps_the_plant(const Frame& frame) const noexcept FEEDTWIN_REALTIME {
  return frame.id == sync_id;
}

}  // namespace feedtwin::io::can
