#pragma once
// A controller's side of io/udp/datagram.h, written from its description: a socket, requests in bytes, replies out of them.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "io/descriptor.h"

namespace feedtwin::io::udp::test {

using Bytes = std::vector<std::uint8_t>;

template <class Number>
void append(Bytes& bytes, Number number) {
  std::uint8_t raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.insert(bytes.end(), raw, raw + sizeof number);
}

template <class Number>
Number at(const Bytes& bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

struct Command {
  double torque_Nm = 0.0;
  std::uint16_t control = 1, watchdog_ms = 0;
};

inline Bytes request(std::uint32_t sequence, const std::vector<Command>& axes, std::uint64_t stamp = 0) {
  Bytes bytes{'F', 'T', 'W', 'N', 1, 1, static_cast<std::uint8_t>(axes.size()), 0};
  append(bytes, sequence);
  append(bytes, std::uint32_t{0});
  append(bytes, stamp);
  for (const Command& axis : axes) {
    append(bytes, axis.torque_Nm);
    append(bytes, axis.control);
    append(bytes, axis.watchdog_ms);
    append(bytes, std::uint32_t{0});
  }
  return bytes;
}

class Peer {
 public:
  explicit Peer(int port) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  bool send(const Bytes& bytes) {
    return connected_ && ::send(socket_.get(), bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
  }
  /// The next reply; none within the time given.
  std::optional<Bytes> receive(int wait_ms = 2000) {
    pollfd waiting{.fd = socket_.get(), .events = POLLIN, .revents = 0};
    if (::poll(&waiting, 1, wait_ms) <= 0) return std::nullopt;
    Bytes bytes(4096);
    const auto size = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
    if (size < 0) return std::nullopt;
    bytes.resize(static_cast<std::size_t>(size));
    return bytes;
  }

 private:
  Descriptor socket_;
  bool connected_ = false;
};

}  // namespace feedtwin::io::udp::test
