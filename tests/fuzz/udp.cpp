// Any bytes as a UDP request: refused, or read within its bounds; what is read gives the same bytes when written again.

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "io/udp/datagram.h"
#include "io/udp/session.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace feedtwin::io;
  constexpr std::size_t plant_axes = 5;
  udp::Request request;
  if (udp::decode({data, size}, plant_axes, request)) {
    if (request.axes < 1 || request.axes > plant_axes) std::abort();
    if (size != udp::request_header_bytes + request.axes * udp::request_axis_bytes) std::abort();
    for (std::size_t i = 0; i < request.axes; ++i) {
      const std::uint8_t* field = data + udp::request_header_bytes + i * udp::request_axis_bytes;
      if (std::memcmp(&request.axis[i].torque_Nm, field, sizeof(double)) != 0) std::abort();
      if (request.axis[i].watchdog_ns < 0 || request.axis[i].watchdog_ns > 65'535'000'000) std::abort();
    }
  }
  // the same bytes as a history of sequences from two peers: what is used never goes back within a session
  udp::Session session(50);
  std::uint32_t last = 0;
  for (std::size_t i = 0; i + 4 < size; i += 5) {
    std::uint32_t sequence = 0;
    std::memcpy(&sequence, data + i, sizeof sequence);
    const auto before = session.sessions();
    const auto verdict =
        session.judge({1, static_cast<std::uint16_t>(data[i + 4] & 1U)}, sequence, static_cast<std::int64_t>(i));
    if (verdict != udp::Session::Verdict::use) continue;
    if (session.sessions() == before && static_cast<std::int32_t>(sequence - last) <= 0) std::abort();
    last = sequence;
  }
  return 0;
}
