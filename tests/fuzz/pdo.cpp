// Whatever comes over the bus (commands, SYNC, network management, remapping by SDO, heartbeats), torque acts in operation
// enabled only, is finite and within 6072, and what goes out are frames.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "io/can/canopen_node.h"

using namespace feedtwin::io;
using namespace feedtwin::io::can;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

/// NMT: every node is to start afresh.
constexpr Frame reset_node{.id = 0x000, .length = 2, .data = {0x81, 0}};

constexpr std::uint16_t ids[] = {0x000, 0x080, 0x201, 0x301, 0x401, 0x501, 0x601, 0x77F};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // one node for all inputs, put back by the reset that a master has: building it costs more than an input
  static CanopenNode node(DriveIdentity{});
  static FrameQueue out;
  static std::int64_t now_ns = 0;
  AxisRequest request;
  AxisReport axis;
  node.accept(reset_node, now_ns, out);
  node.report(axis, now_ns, out);
  node.take_request(request);
  while (!out.empty()) out.pop();
  while (size >= 2) {  // which frame and how long, whether a tick follows, then its bytes
    Frame frame;
    frame.id =
        (data[0] & 0x08) != 0 && size >= 4 ? static_cast<std::uint16_t>((data[2] | data[3] << 8) & 0x7FF) : ids[data[0] & 7];
    frame.remote = (data[0] & 0xF0) == 0xF0;
    frame.length = (data[1] & 0x0F) < 8 ? static_cast<std::uint8_t>(data[1] & 0x0F) : std::uint8_t{8};
    const bool tick = (data[1] & 0x80) != 0;
    data += 2;
    size -= 2;
    const std::size_t n = size < frame.length ? size : frame.length;
    std::memcpy(frame.data.data(), data, n);
    node.accept(frame, now_ns, out);
    if (tick) {
      now_ns += (data - 1)[0] & 0x40 ? 50'000'000 : 1'000'000;
      axis.encoder_counts += frame.data[0] * 0x1234567LL;
      axis.torque_Nm = request.torque_Nm * frame.data[1];
      axis.velocity_m_per_s = frame.data[2] * 1e3;
      axis.sequence = request.sequence;
      axis.state = (frame.data[3] & 0xE0) == 0xE0 ? DriveState::fault : DriveState::enabled;
      node.report(axis, now_ns, out);
    }
    data += n;
    size -= n;
    if (node.take_request(request)) {
      require(std::isfinite(request.torque_Nm) && std::abs(request.torque_Nm) <= 32.767 * 1.27 + 1e-9);
      require(node.drive_state() == Cia402State::operation_enabled || request.torque_Nm == 0.0);
    }
    for (; !out.empty(); out.pop()) require(out.front().length <= 8 && out.front().id <= largest_id);
  }
  return 0;
}
