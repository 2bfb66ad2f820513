#include "io/can/can_port.h"

#include <algorithm>
#include <chrono>

#include "io/can/canopen_node.h"
#include "io/can/odrive_node.h"
#include "io/can/socketcan_link.h"

namespace feedtwin::io::can {
namespace {

constexpr auto supervision_period = std::chrono::milliseconds(20);
constexpr std::int64_t longest_wait_ns = 50'000'000;  // to look after heartbeats and the end where no tick comes

std::unique_ptr<Device> make_device(Settings& settings, const PortContext::Axis& axis, int index) {
  const auto personality = settings.word("personality", {"canopen", "odrive"}, "canopen");
  if (personality == "canopen") {
    const auto first = static_cast<int>(settings.integer("node_id", 1, 127, 1));
    if (first + index > 127)
      settings.fail("node_id", "the axes take one node each, from here on; the last would be above 127");
    return std::make_unique<CanopenNode>(DriveIdentity{static_cast<std::uint8_t>(first + index), axis.rated_torque_Nm,
                                                       axis.encoder_counts_per_rev, axis.lead_m});
  }
  const auto first = static_cast<int>(settings.integer("node_id", 0, 63, 0));
  if (first + index > 63) settings.fail("node_id", "the axes take one node each, from here on; the last would be above 63");
  OdriveSettings odrive;
  odrive.node_id = static_cast<std::uint8_t>(first + index);
  odrive.encoder_counts_per_rev = axis.encoder_counts_per_rev;
  odrive.lead_m = axis.lead_m;
  odrive.heartbeat_ms = static_cast<int>(settings.integer("heartbeat_ms", 0, 10000, 100));
  odrive.encoder_ms = static_cast<int>(settings.integer("encoder_ms", 0, 10000, 1));
  odrive.watchdog_ms = static_cast<int>(settings.integer("watchdog_ms", 0, 10000, 250));
  return std::make_unique<OdriveNode>(odrive);
}

}  // namespace

CanPort::CanPort(std::unique_ptr<Link> link, std::vector<std::unique_ptr<Device>> devices, const CanPortSettings& settings)
    : settings_(settings), nodes_(std::move(link), std::move(devices)) {}

void CanPort::open() {
  nodes_.link().open();
  std::vector<std::uint16_t> ids;
  nodes_.gather_ids(ids);
  nodes_.link().listen(ids);
  if (settings_.supervised) supervisor_ = std::jthread([this](const std::stop_token& stop) { supervise(stop); });
  if (settings_.answers_at_once) server_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void CanPort::close() noexcept {
  supervisor_ = {};
  if (server_.joinable()) {
    server_.request_stop();
    nodes_.link().wake();
    server_ = {};
  }
  nodes_.link().close();
}

/// A remapped PDO may need another filter, and a bus that is off a restart; neither has a place in the tick.
void CanPort::supervise(const std::stop_token& stop) {
  std::vector<std::uint16_t> listening, ids;
  nodes_.gather_ids(listening);
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(supervision_period);
    nodes_.gather_ids(ids);
    if (ids != listening) {
      listening = ids;
      nodes_.link().listen(listening);
    }
    nodes_.link().supervise(nodes_.link().now_ns());
  }
}

void CanPort::run(const std::stop_token& stop) noexcept {
  rank_.take(settings_.priority);
  while (!stop.stop_requested()) {
    serve();
    // after its most frames in a tick it waits for the next one, whatever else comes: a flood must not take the core
    const auto by = nodes_.may_take_more() ? WakeUp::frame : WakeUp::call;
    if (!nodes_.link().wait(nodes_.link().now_ns() + longest_wait_ns, by)) nodes_.renew_allowance();
  }
}

void CanPort::serve() noexcept FEEDTWIN_REALTIME {
  if (reports_.take()) {  // first, so that a SYNC is answered with the newest state
    std::uint64_t failed = failed_encoders_.exchange(0, std::memory_order_relaxed);
    for (std::size_t axis = 0; failed != 0; ++axis, failed >>= 1U) {
      if ((failed & 1U) != 0) nodes_.encoder_failed(axis);
    }
    nodes_.report({reports_.newest().axis.data(), reports_.newest().axes});
  }
  nodes_.drain(false);
  pass_on_requests();
}

void CanPort::pass_on_requests() noexcept FEEDTWIN_REALTIME {
  const bool used = !requests_.only_watched();
  bool news = false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    AxisRequest request;
    if (!nodes_.take_request(i, request)) continue;
    if (!used && request.enable) ++not_in_command_;
    requests_.put(i, request);
    news = true;
  }
  MachineRequest machine;
  if (nodes_.take_machine_request(machine)) {
    requests_.put(machine);
    news = true;
  }
  if (news && used) requests_.hand_over();
}

std::uint64_t CanPort::receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME {
  if (settings_.answers_at_once) return requests_.receive(newest);
  asked_ = true;
  if (!lockstep_) nodes_.drain(false);
  std::uint64_t fresh = 0;
  for (std::size_t i = 0; i < nodes_.size() && i < newest.size(); ++i) {
    if (nodes_.take_request(i, newest[i])) fresh |= std::uint64_t{1} << i;
  }
  return fresh;
}

bool CanPort::receive_machine(MachineRequest& newest) noexcept FEEDTWIN_REALTIME {
  return settings_.answers_at_once ? requests_.receive_machine(newest) : nodes_.take_machine_request(newest);
}

void CanPort::send(const TickReport& /*tick*/, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME {
  if (settings_.answers_at_once) {
    Reports& reports = reports_.draft();
    reports.axes = std::min(axes.size(), reports.axis.size());
    std::copy_n(axes.begin(), reports.axes, reports.axis.begin());
    reports_.post();
    requests_.sent();
    nodes_.link().wake();
    return;
  }
  if (!asked_ && sent_before_) serve_unasked();  // the first report comes before the first tick
  asked_ = false;
  sent_before_ = true;
  nodes_.report(axes);
}

void CanPort::serve_unasked() noexcept FEEDTWIN_REALTIME {
  nodes_.drain(lockstep_);
  AxisRequest unused;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_.take_request(i, unused) && unused.enable) ++not_in_command_;
  }
}

bool CanPort::wait_for_request(std::int64_t until_ns) noexcept {
  lockstep_ = true;
  while (true) {
    if (nodes_.drain(true)) return true;
    if (!nodes_.link().wait(until_ns, WakeUp::frame)) return false;
    nodes_.renew_allowance();
  }
}

bool CanPort::break_encoder(EncoderFault fault, int axis, bool on, std::int64_t /*amount*/) noexcept FEEDTWIN_REALTIME {
  // A drive notices a dead line; lost counts, a swapped pair or a missing index it takes for motion.
  const bool noticed = fault == EncoderFault::dead_a || fault == EncoderFault::dead_b || fault == EncoderFault::dead_index;
  if (on && noticed && axis >= 0 && axis < max_axes) {
    if (settings_.answers_at_once) {
      failed_encoders_.fetch_or(std::uint64_t{1} << axis, std::memory_order_relaxed);
    } else {
      nodes_.encoder_failed(static_cast<std::size_t>(axis));
    }
  }
  return false;  // no lines of its own: the counts have to be falsified on their way here
}

std::vector<Counter> CanPort::counters() const {
  std::vector<Counter> all;
  nodes_.add_counters(all);
  all.push_back(
      {"not_in_command", "enabled requests that came while another port commands, not used", not_in_command_, false});
  if (settings_.answers_at_once) {
    all.push_back({"superseded", "requests that a newer one replaced before a tick came", requests_.superseded().value()});
  }
  return all;
}

std::unique_ptr<Port> make_can_port(Settings& settings, const PortContext& context) {
  SocketCanSettings socket;
  socket.interface = settings.text("interface", "vcan0");
  if (socket.interface.empty() || socket.interface.size() > 15)
    settings.fail("interface", "expected a network interface's name");
  socket.restart_ms = static_cast<int>(settings.integer("restart_ms", 0, 60000, 100));
  std::vector<std::unique_ptr<Device>> devices;
  for (int i = 0; i < context.axes; ++i) {
    devices.push_back(make_device(settings, context.axis[static_cast<std::size_t>(i)], i));
  }
  CanPortSettings can;
  can.supervised = true;
  can.answers_at_once = !context.lockstep;
  can.priority = static_cast<int>(settings.integer("priority", 0, 98, can.priority));
  return std::make_unique<CanPort>(std::make_unique<SocketCanLink>(socket), std::move(devices), can);
}

}  // namespace feedtwin::io::can
