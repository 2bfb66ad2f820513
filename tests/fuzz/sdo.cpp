// Whatever requests come, the SDO server answers with a frame of its own of 8 bytes or not at all, and no object leaves its
// limits.

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "io/can/canopen_node.h"

using namespace feedtwin::io::can;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

/// NMT: node 1 is to start afresh.
constexpr Frame reset_node{.id = 0x000, .length = 2, .data = {0x81, 1}};

void check(const CanopenNode& node) {
  const auto table = object_table();
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto& entry = table[i];
    if (entry.type == DataType::text || entry.index == 0x1003) continue;
    const auto value = node.objects().get(static_cast<int>(i));
    require(value >= entry.lowest && value <= entry.highest);
    if (entry.access == Access::constant) require(value == preset_of(entry, DriveIdentity{}));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // one node for all inputs, put back by the reset that a master has: building it costs more than an input
  static CanopenNode node(DriveIdentity{});
  static FrameQueue out;
  static std::int64_t now_ns = 0;
  node.accept(reset_node, now_ns, out);
  while (!out.empty()) out.pop();
  for (; size > 0; ++data, --size) {  // a byte of length and time, then the request
    Frame request;
    request.id = 0x601;
    request.length = (data[0] & 0x0F) < 8 ? static_cast<std::uint8_t>(data[0] & 0x0F) : std::uint8_t{8};
    now_ns += (data[0] & 0x80) != 0 ? 2'000'000'000 : 1'000'000;
    const std::size_t n = size - 1 < request.length ? size - 1 : request.length;
    std::memcpy(request.data.data(), data + 1, n);
    data += n;
    size -= n;
    node.accept(request, now_ns, out);
    for (; !out.empty(); out.pop()) require(out.front().length == 8 && (out.front().id == 0x581 || out.front().id == 0x081));
  }
  check(node);
  return 0;
}
