#pragma once
// A Modbus client that can do everything wrong: raw bytes over a socket. Waits at most two seconds for anything.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstdint>

#include "io/descriptor.h"
#include "tests/io/modbus/frames.h"

namespace feedtwin::io::modbus::test {

class Client {
 public:
  explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
    const int on = 1;
    setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  [[nodiscard]] bool connected() const { return connected_; }

  bool send(const Bytes& bytes) {
    return ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  /// The next whole reply; empty on time-out or when the server has closed.
  Bytes receive() {
    Bytes reply = take(6);
    if (reply.size() < 6) return {};
    const Bytes rest = take(static_cast<std::size_t>(reply[4] << 8 | reply[5]));
    reply.insert(reply.end(), rest.begin(), rest.end());
    return reply;
  }
  Bytes ask(const Bytes& request) { return send(request) ? receive() : Bytes{}; }
  /// Wait for the server to close; whatever it still sends is thrown away.
  bool closed_by_server() {
    for (;;) {
      pollfd waiting{.fd = socket_.get(), .events = POLLIN, .revents = 0};
      if (::poll(&waiting, 1, 2000) <= 0) return false;
      char sink[4096];
      if (::recv(socket_.get(), sink, sizeof sink, 0) <= 0) return true;
    }
  }
  void close() { socket_.reset(); }
  [[nodiscard]] int socket() const { return socket_.get(); }

 private:
  Bytes take(std::size_t count) {
    Bytes bytes;
    while (bytes.size() < count) {
      pollfd waiting{.fd = socket_.get(), .events = POLLIN, .revents = 0};
      if (::poll(&waiting, 1, 2000) <= 0) return {};
      std::uint8_t buffer[512];
      const auto n = ::recv(socket_.get(), buffer, std::min(count - bytes.size(), sizeof buffer), 0);
      if (n <= 0) return {};
      bytes.insert(bytes.end(), buffer, buffer + n);
    }
    return bytes;
  }

  Descriptor socket_;
  bool connected_ = false;
};

}  // namespace feedtwin::io::modbus::test
