// Whatever comes over the bus, torque is finite and acts in closed loop only.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "io/can/odrive_node.h"

using namespace feedtwin::io;
using namespace feedtwin::io::can;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  OdriveNode node(OdriveSettings{.node_id = 1});
  FrameQueue out;
  AxisRequest request;
  AxisReport axis;
  std::int64_t now_ns = 0;
  node.start(now_ns, out);
  while (size >= 2) {  // the command, its length and whether a tick follows, then its bytes
    Frame frame;
    frame.id = static_cast<std::uint16_t>(((data[0] & 0x40) != 0 ? 2 : 1) << 5 | (data[0] & 0x1F));
    frame.remote = (data[0] & 0x20) != 0;
    frame.length = (data[1] & 0x0F) < 8 ? static_cast<std::uint8_t>(data[1] & 0x0F) : std::uint8_t{8};
    const bool tick = (data[1] & 0x80) != 0, pause = (data[1] & 0x40) != 0;
    data += 2;
    size -= 2;
    const std::size_t n = size < frame.length ? size : frame.length;
    std::memcpy(frame.data.data(), data, n);
    data += n;
    size -= n;
    node.accept(frame, now_ns, out);
    if (tick) {
      now_ns += pause ? 200'000'000 : 1'000'000;
      axis.encoder_counts -= frame.data[0] * 0x1234567LL;
      axis.velocity_m_per_s = frame.data[2] * -1e3;
      node.report(axis, now_ns, out);
    }
    if (node.take_request(request)) {
      require(std::isfinite(request.torque_Nm));
      require(node.closed_loop() || request.torque_Nm == 0.0);
    }
    for (; !out.empty(); out.pop()) require(out.front().length <= 8 && out.front().id <= largest_id);
  }
  return 0;
}
