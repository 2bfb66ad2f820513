// Any bytes as a Modbus TCP stream, over libmodbus to a real socket: every frame gets one well-formed reply of its own,
// and no torque beyond rated reaches the loop.

#include <modbus.h>
#include <sys/socket.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "io/modbus/responder.h"

namespace {

using namespace feedtwin::io;

void require(bool condition) {
  if (!condition) std::abort();
}

void check_reply(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply) {
  require(reply.size() >= 9 && reply.size() <= 260);
  require(reply[0] == request[0] && reply[1] == request[1]);                        // transaction
  require(static_cast<std::size_t>(reply[4] << 8 | reply[5]) + 6 == reply.size());  // length
  require((reply[7] & 0x7F) == (request[7] & 0x7F));                                // function
  if (reply[7] == request[7] && (request[7] == 3 || request[7] == 4 || request[7] == 23)) {
    require(reply[8] == 2 * (request[10] << 8 | request[11]) && reply.size() == 9U + reply[8]);
  } else if (reply[7] != request[7]) {
    require(reply.size() == 9 && (reply[8] == 1 || reply[8] == 2 || reply[8] == 3 || reply[8] == 6));
  } else {
    require(request[7] == 6 || request[7] == 16);
  }
}

struct Bench {
  static constexpr int axes = 3;
  modbus_t* context = modbus_new_tcp("127.0.0.1", 0);
  std::array<int, 2> sockets{};
  Bench() { require(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, sockets.data()) == 0); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Bench bench;
  modbus::Exchange exchange({.axes = Bench::axes, .axis = {}});
  modbus::Responder responder(bench.context, exchange, 5);
  std::array<AxisReport, Bench::axes> reports{};
  std::array<AxisRequest, Bench::axes> requests{};
  std::span<const std::uint8_t> stream(data, size);
  for (std::uint64_t n = 0;; ++n) {
    const auto cut = modbus::cut_frame(stream);
    if (cut.malformed || cut.bytes == 0) break;
    const auto frame = stream.first(cut.bytes);
    // two clients in turn, as the unit identifier has it
    require(responder.answer(bench.sockets[0], frame[6] & 1U, frame, static_cast<std::int64_t>(n)));
    std::array<std::uint8_t, 512> reply{};
    const auto got = recv(bench.sockets[1], reply.data(), reply.size(), MSG_DONTWAIT);
    require(got > 0);
    check_reply(frame, {reply.data(), static_cast<std::size_t>(got)});
    exchange.requests().receive(requests);
    for (const auto& request : requests) require(std::abs(request.torque_Nm) <= 1.27 * (1 + 1e-12));
    exchange.send({.tick = n, .missed_ticks = 0, .start_ns = 0}, reports);
    if (frame.size() % 7 == 0) responder.leave(frame[6] & 1U);
    stream = stream.subspan(cut.bytes);
  }
  return 0;
}
