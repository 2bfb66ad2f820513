#pragma once
// The Modbus TCP server: sockets and clients, on a thread of its own that never holds up the tick.
//
// Every socket is non-blocking and every client has one fixed buffer, so that a client who sends slowly, sends nonsense,
// does not read or never goes away costs that buffer and nothing else:
//   - a request that is not complete within the request time closes the connection;
//   - a frame that is not Modbus closes the connection, because its end can't be known;
//   - replies that the client does not read, once the socket's buffer is full, close the connection;
//   - one client more than allowed replaces the one longest silent (never the one in command);
//   - a peer that vanished is found by TCP's own keep-alive.

#include <atomic>
#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <thread>

#include "io/descriptor.h"
#include "io/modbus/exchange.h"
#include "io/modbus/responder.h"
#include "io/tally.h"

namespace feedtwin::io::modbus {

struct ServerSettings {
  std::string address = "127.0.0.1";
  int port = 1502;  ///< 0: one that is free
  int max_clients = 32;
  std::int64_t request_time_ns = 1'000'000'000;
  std::int64_t command_idle_ns = 1'000'000'000;
};

struct ConnectionTallies {
  Tally accepted, replaced, malformed, slow, no_descriptor;
};

class Server {
 public:
  /// Listens and starts the thread. Throws PortError.
  Server(const ServerSettings& settings, Exchange& exchange);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server();

  [[nodiscard]] int port() const noexcept { return port_; }
  [[nodiscard]] const ConnectionTallies& connections() const noexcept { return connections_; }
  [[nodiscard]] const Responder& responder() const noexcept { return responder_; }

 private:
  struct Connection;
  using Connections = std::list<Connection>;

  void listen();
  void run() noexcept;
  void accept_waiting(std::int64_t now_ns) noexcept;
  void admit(Descriptor socket, std::int64_t now_ns);
  void make_room() noexcept;
  void serve(Connection& connection) noexcept;
  [[nodiscard]] bool answer_all(Connection& connection, std::int64_t arrival_ns) noexcept;
  void tend(std::int64_t now_ns) noexcept;
  void drop(Connection& connection) noexcept;
  void watch_listener(bool on) noexcept;

  struct FreeContext {
    void operator()(modbus_t* context) const noexcept;
  };

  ServerSettings settings_;
  std::unique_ptr<modbus_t, FreeContext> context_;
  Responder responder_;
  Descriptor listener_, epoll_, stop_;
  int port_ = 0;
  ClientId next_client_ = 1;
  Connections clients_;
  bool listening_ = false, any_dropped_ = false;
  ConnectionTallies connections_;
  std::thread thread_;
};

}  // namespace feedtwin::io::modbus
