#pragma once
// A CANopen master for tests, on its own station of a twin bus, with a CanPort of drives on another: blocking calls that let
// the bus's time pass.

#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/can/can_port.h"
#include "io/can/canopen_node.h"
#include "io/can/twin_bus.h"

namespace feedtwin::io::can {

[[nodiscard]] inline Frame make_frame(int id, std::initializer_list<int> bytes) {
  Frame frame;
  frame.id = static_cast<std::uint16_t>(id);
  for (const int byte : bytes) frame.data[frame.length++] = static_cast<std::uint8_t>(byte);
  return frame;
}

/// A bus with `axes` drives in a port, a tick of 1 ms, and a master. The plant is a free mass that the test can look into.
class BusWithMaster {
 public:
  static constexpr std::int64_t tick_ns = 1'000'000;

  explicit BusWithMaster(int axes = 1, double bits_per_s = 1e6)
      : bus(bits_per_s), requests(static_cast<std::size_t>(axes)), reports(static_cast<std::size_t>(axes)) {
    std::vector<std::unique_ptr<Device>> devices;
    for (int i = 0; i < axes; ++i) {
      DriveIdentity drive;
      drive.node_id = static_cast<std::uint8_t>(1 + i);
      auto node = std::make_unique<CanopenNode>(drive);
      nodes.push_back(node.get());
      devices.push_back(std::move(node));
    }
    port = std::make_unique<CanPort>(bus.connect(), std::move(devices), CanPortSettings{});
    master = bus.connect();
    port->open();
    tick();
  }

  /// One tick of the plant server, then the master hears what has come.
  void tick() {
    bus.run_to(bus.now_ns() + tick_ns);
    if (!another_commands) fresh = port->receive(requests);
    for (std::size_t i = 0; i < reports.size(); ++i) {
      reports[i].sequence = requests[i].sequence;
      if (on_tick) on_tick(i);
    }
    port->send({}, reports);
    // replies go out at once; the master hears them before the next tick
    bus.run_to(bus.now_ns() + tick_ns / 2);
    ReceivedFrame frame;
    while (master->receive(frame)) heard.push_back(frame.frame);
  }
  void say(const Frame& frame) { ASSERT_EQ(master->send(frame), Sent::yes); }
  void nmt(int command, int node = 0) {
    say(make_frame(0, {command, node}));
    tick();
  }
  void sync() {
    say(make_frame(0x80, {}));
    tick();
  }
  /// RPDO 1 in its default mapping, then SYNC.
  void command(int node, int controlword, int per_mille) {
    say(make_frame(0x200 + node,
                   {controlword & 0xFF, controlword >> 8 & 0xFF, per_mille & 0xFF, per_mille >> 8 & 0xFF, 10}));
    sync();
  }
  [[nodiscard]] std::optional<Frame> last(int id) const {
    for (auto f = heard.rbegin(); f != heard.rend(); ++f) {
      if (f->id == id) return *f;
    }
    return std::nullopt;
  }
  [[nodiscard]] int count(int id) const {
    int n = 0;
    for (const auto& frame : heard) n += frame.id == id ? 1 : 0;
    return n;
  }

  // SDO: the client's side, written from CiA 301 apart from the server.
  std::optional<Frame> ask(int node, std::initializer_list<int> bytes) {
    heard.clear();
    say(make_frame(0x600 + node, bytes));
    tick();
    return last(0x580 + node);
  }
  /// The value of an expedited upload; an abort code is shown as a failure.
  [[nodiscard]] std::int64_t read(int index, int sub = 0, int node = 1) {
    const auto reply = ask(node, {0x40, index & 0xFF, index >> 8, sub, 0, 0, 0, 0});
    if (!reply || (reply->data[0] & 0xE3) != 0x43) {
      ADD_FAILURE() << std::hex << "no expedited upload of " << index << ":" << sub << ", abort "
                    << (reply ? load<std::uint32_t>(*reply, 4) : 0);
      return 0;
    }
    const std::size_t n = 4U - (reply->data[0] >> 2 & 3U);
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < n; ++i) value |= static_cast<std::uint32_t>(reply->data[4 + i]) << (8 * i);
    return value;
  }
  /// 0, or the abort code.
  std::uint32_t write(int index, int sub, std::int64_t value, int bytes, int node = 1) {
    const auto v = static_cast<std::uint32_t>(value);
    const auto b = [v](unsigned i) { return static_cast<int>(v >> (8 * i) & 0xFFU); };
    const auto reply = ask(node, {0x23 | (4 - bytes) << 2, index & 0xFF, index >> 8, sub, b(0), b(1), b(2), b(3)});
    if (!reply) return 0xFFFF'FFFF;
    return reply->data[0] == 0x60 ? 0 : load<std::uint32_t>(*reply, 4);
  }
  [[nodiscard]] std::string read_text(int index) {
    auto reply = ask(1, {0x40, index & 0xFF, index >> 8, 0, 0, 0, 0, 0});
    std::string text;
    if (!reply || reply->data[0] != 0x41) return "no segmented upload";
    const auto length = load<std::uint32_t>(*reply, 4);
    for (int toggle = 0;; toggle ^= 0x10) {
      reply = ask(1, {0x60 | toggle, 0, 0, 0, 0, 0, 0, 0});
      if (!reply || (reply->data[0] & 0xF0) != toggle) return "wrong segment";
      const std::size_t n = 7U - (reply->data[0] >> 1 & 7U);
      text.append(reinterpret_cast<const char*>(reply->data.data()) + 1, n);
      if ((reply->data[0] & 1) != 0) return text.size() == length ? text : "wrong length";
    }
  }

  /// NMT start, then 06, 07, 0F by RPDO and SYNC.
  void enable(int node = 1) {
    nmt(1, node);
    for (const int controlword : {0x06, 0x07, 0x0F}) command(node, controlword, 0);
    ASSERT_EQ(nodes[static_cast<std::size_t>(node - 1)]->drive_state(), Cia402State::operation_enabled);
  }

  /// All of them together, as a drive that is enabled misses its commands otherwise.
  void enable_all() {
    nmt(1);
    for (const int word : {0x06, 0x07, 0x0F}) {
      for (int node = 1; node <= static_cast<int>(nodes.size()); ++node) say(make_frame(0x200 + node, {word, 0, 0, 0, 10}));
      sync();
    }
    for (const auto* node : nodes) ASSERT_EQ(node->drive_state(), Cia402State::operation_enabled);
  }

  TwinBus bus;
  std::vector<CanopenNode*> nodes;
  std::unique_ptr<CanPort> port;
  std::unique_ptr<Link> master;
  std::vector<AxisRequest> requests;
  std::vector<AxisReport> reports;
  std::vector<Frame> heard;
  std::uint64_t fresh = 0;
  bool another_commands = false;  ///< this port only listens
  std::function<void(std::size_t)> on_tick;
};

}  // namespace feedtwin::io::can
