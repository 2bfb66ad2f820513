#include "io/can/can_port.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "io/can/canopen_node.h"
#include "io/can/odrive_node.h"
#include "io/can/socketcan_link.h"

namespace feedtwin::io::can {
namespace {

constexpr auto supervision_period = std::chrono::milliseconds(20);

/// Emergencies and SDO replies each say something of their own; every other frame is a state that a newer one replaces.
bool cyclic(const Frame& frame) noexcept FEEDTWIN_REALTIME {
  return frame.id > 0x180 && frame.id < 0x580;
}

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

CanPort::CanPort(std::unique_ptr<Link> link, std::vector<std::unique_ptr<Device>> devices, bool supervised)
    : link_(std::move(link)), devices_(std::move(devices)), supervised_(supervised) {}

void CanPort::open() {
  link_->open();
  std::vector<std::uint16_t> ids;
  gather_ids(ids);
  link_->listen(ids);
  if (supervised_) supervisor_ = std::jthread([this](const std::stop_token& stop) { supervise(stop); });
}

void CanPort::close() noexcept {
  supervisor_ = {};
  link_->close();
}

void CanPort::gather_ids(std::vector<std::uint16_t>& ids) const {
  ids.clear();
  std::array<std::uint16_t, Device::most_ids> own{};
  for (const auto& device : devices_) {
    device->listens_to(own);
    ids.insert(ids.end(), own.begin(), own.end());
  }
  std::ranges::sort(ids);
  const auto rest = std::ranges::unique(ids);
  ids.erase(rest.begin(), rest.end());
}

/// A remapped PDO may need another filter, and a bus that is off a restart; neither has a place in the tick.
void CanPort::supervise(const std::stop_token& stop) {
  std::vector<std::uint16_t> listening, ids;
  gather_ids(listening);
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(supervision_period);
    gather_ids(ids);
    if (ids != listening) {
      listening = ids;
      link_->listen(listening);
    }
    link_->supervise(link_->now_ns());
  }
}

bool CanPort::drain() noexcept FEEDTWIN_REALTIME {
  if (!started_) {
    started_ = true;
    for (auto& device : devices_) device->start(link_->now_ns(), fresh_);
  }
  if (link_->take_recovery()) {
    ++counters_.recoveries;
    for (auto& device : devices_) device->bus_recovered(link_->now_ns(), fresh_);
  }
  trigger_ns_ = reply_ns_ = -1;
  ReceivedFrame received;
  bool step = false;
  int taken = 0;
  while (taken < most_frames && !(step && lockstep_) && link_->receive(received)) {
    ++taken;
    ++counters_.received;
    for (auto& device : devices_) {
      device->accept(received.frame, received.arrival_ns, fresh_);
      if (!device->steps_the_plant(received.frame)) continue;
      step = true;
      trigger_ns_ = received.arrival_ns;
    }
  }
  if (taken == most_frames) ++counters_.left_for_next_tick;
  const bool answers = !fresh_.empty();
  flush();
  if (trigger_ns_ >= 0 && answers && waiting_.empty()) reply_ns_ = link_->now_ns() - trigger_ns_;
  return step;
}

void CanPort::enqueue() noexcept FEEDTWIN_REALTIME {
  for (; !fresh_.empty(); fresh_.pop()) {
    const Frame& frame = fresh_.front();
    if (cyclic(frame) && waiting_.replace(frame)) {
      ++counters_.replaced;
    } else if (!waiting_.push(frame)) {
      ++counters_.lost;
    }
  }
}

void CanPort::flush() noexcept FEEDTWIN_REALTIME {
  enqueue();
  while (!waiting_.empty()) {
    const Sent result = link_->send(waiting_.front());
    if (result == Sent::later) {
      ++counters_.delayed;
      return;
    }
    ++(result == Sent::yes ? counters_.sent : counters_.lost);
    waiting_.pop();
  }
}

std::uint64_t CanPort::receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME {
  asked_ = true;
  if (!lockstep_) drain();
  std::uint64_t fresh = 0;
  for (std::size_t i = 0; i < devices_.size() && i < newest.size(); ++i) {
    if (!devices_[i]->take_request(newest[i])) continue;
    newest[i].reply_ns = reply_ns_;
    fresh |= std::uint64_t{1} << i;
  }
  return fresh;
}

void CanPort::send(const TickReport& /*tick*/, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME {
  if (!asked_ && sent_before_) serve_unasked();  // the first report comes before the first tick
  asked_ = false;
  sent_before_ = true;
  const std::int64_t now_ns = link_->now_ns();
  for (std::size_t i = 0; i < devices_.size() && i < axes.size(); ++i) devices_[i]->report(axes[i], now_ns, fresh_);
  flush();
}

void CanPort::serve_unasked() noexcept FEEDTWIN_REALTIME {
  drain();
  AxisRequest unused;
  for (auto& device : devices_) {
    if (device->take_request(unused) && unused.enable) ++counters_.not_in_command;
  }
}

bool CanPort::wait_for_request(std::int64_t until_ns) noexcept {
  lockstep_ = true;
  while (true) {
    if (drain()) return true;
    if (!link_->wait(until_ns)) return false;
  }
}

bool CanPort::break_encoder(EncoderFault fault, int axis, bool on, std::int64_t /*amount*/) noexcept FEEDTWIN_REALTIME {
  // A drive notices a dead line; lost counts, a swapped pair or a missing index it takes for motion.
  const bool noticed = fault == EncoderFault::dead_a || fault == EncoderFault::dead_b || fault == EncoderFault::dead_index;
  if (on && noticed && axis >= 0 && static_cast<std::size_t>(axis) < devices_.size()) {
    devices_[static_cast<std::size_t>(axis)]->encoder_failed(link_->now_ns(), fresh_);
  }
  return false;  // no lines of its own: the counts have to be falsified on their way here
}

std::vector<Counter> CanPort::counters() const {
  std::vector<Counter> all;
  const auto add = [&](const char* name, const char* meaning, std::uint64_t value, bool loses_data = false) {
    all.push_back({name, meaning, value, loses_data});
  };
  add("received", "frames taken from the bus", counters_.received);
  add("sent", "frames given to the adapter", counters_.sent);
  add("left_for_next_tick", "ticks in which more frames had come than one tick takes", counters_.left_for_next_tick);
  add("delayed", "ticks in which the adapter had no room (ENOBUFS)", counters_.delayed);
  add("replaced", "cyclic frames that waited and were overtaken by a newer one", counters_.replaced);
  add("lost", "frames that could not be sent", counters_.lost + fresh_.refused(), true);
  add("not_in_command", "enabled requests that came while another port commands, not used", counters_.not_in_command);
  add("bus_recoveries", "times that the bus came back", counters_.recoveries, true);
  link_->add_counters(all);
  for (std::size_t i = 0; i < devices_.size(); ++i) devices_[i]->add_counters("axis " + std::to_string(i) + " ", all);
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
  return std::make_unique<CanPort>(std::make_unique<SocketCanLink>(socket), std::move(devices), true);
}

}  // namespace feedtwin::io::can
