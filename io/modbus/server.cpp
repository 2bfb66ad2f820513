#include "io/modbus/server.h"

#include <fcntl.h>
#include <modbus.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <sched.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "io/monotonic.h"

namespace feedtwin::io::modbus {
namespace {

constexpr int events_at_once = 32, accepted_at_once = 16, backlog = 1024;
constexpr int tend_ms = 100;                           // how often slow clients are looked for
constexpr std::size_t buffer_bytes = 2048;             // some requests in flight
constexpr int silence_s = 5, probe_s = 2, probes = 3;  // a vanished peer is found after 11 s

void set(int socket, int level, int option, int value) noexcept {
  setsockopt(socket, level, option, &value, sizeof value);  // a refusal only costs promptness
}

/// Small replies must not wait for the acknowledgement of earlier ones: libmodbus leaves Nagle's algorithm on.
void prepare(int socket) noexcept {
  set(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  set(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(socket, IPPROTO_TCP, TCP_KEEPIDLE, silence_s);
  set(socket, IPPROTO_TCP, TCP_KEEPINTVL, probe_s);
  set(socket, IPPROTO_TCP, TCP_KEEPCNT, probes);
  set(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, 1000 * (silence_s + probe_s * probes));
}

/// The thread that opens the port may be a real-time one: its rank and signals are not for this thread.
void become_ordinary_thread() noexcept {
  const sched_param ordinary{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  pthread_setname_np(pthread_self(), "modbus");
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

}  // namespace

struct Server::Connection {
  Descriptor socket;
  ClientId id = 0;
  std::int64_t last_heard_ns = 0;
  std::int64_t request_began_ns = 0;  ///< of the one that is not complete
  std::size_t used = 0;
  bool dropped = false;
  std::array<std::uint8_t, buffer_bytes> buffer;
};

void Server::FreeContext::operator()(modbus_t* context) const noexcept {
  modbus_set_socket(context, -1);
  modbus_free(context);
}

Server::Server(const ServerSettings& settings, Exchange& exchange)
    : settings_(settings),
      context_(modbus_new_tcp(settings.address.c_str(), settings.port)),
      responder_(context_.get(), exchange, settings.command_idle_ns) {
  listen();
  epoll_ = Descriptor(epoll_create1(EPOLL_CLOEXEC));
  stop_ = Descriptor(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!epoll_ || !stop_) throw PortError(std::string("modbus: ") + std::strerror(errno));
  epoll_event stop{.events = EPOLLIN, .data = {.ptr = &stop_}};
  epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, stop_.get(), &stop);
  watch_listener(true);
  thread_ = std::thread([this] { run(); });
}

Server::~Server() {
  const std::uint64_t one = 1;
  if (thread_.joinable()) {
    [[maybe_unused]] const auto written = ::write(stop_.get(), &one, sizeof one);
    thread_.join();
  }
}

void Server::listen() {
  const std::string where = "modbus: " + settings_.address + ":" + std::to_string(settings_.port) + ": ";
  if (!context_) throw PortError(where + "not an IPv4 address and port");
  listener_ = Descriptor(modbus_tcp_listen(context_.get(), backlog));
  if (!listener_) {
    throw PortError(where + (errno == EADDRINUSE ? "already in use by another program" : std::strerror(errno)));
  }
  fcntl(listener_.get(), F_SETFL, O_NONBLOCK);
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&bound), &size);
  port_ = ntohs(bound.sin_port);
}

void Server::watch_listener(bool on) noexcept {
  if (on == listening_) return;
  epoll_event event{.events = EPOLLIN, .data = {.ptr = &listener_}};
  epoll_ctl(epoll_.get(), on ? EPOLL_CTL_ADD : EPOLL_CTL_DEL, listener_.get(), &event);
  listening_ = on;
}

void Server::run() noexcept {
  become_ordinary_thread();
  std::array<epoll_event, events_at_once> events;
  std::int64_t tended_ns = monotonic_ns();
  for (;;) {
    const bool somebody = !clients_.empty() || !listening_;
    const int count = epoll_wait(epoll_.get(), events.data(), events_at_once, somebody ? tend_ms : -1);
    for (int i = 0; i < count; ++i) {
      void* const source = events[static_cast<std::size_t>(i)].data.ptr;
      if (source == &stop_) return;
      if (source == &listener_) {
        accept_waiting(monotonic_ns());
      } else {
        serve(*static_cast<Connection*>(source));
      }
    }
    if (const std::int64_t now_ns = monotonic_ns(); now_ns - tended_ns >= tend_ms * std::int64_t{1'000'000}) {
      tended_ns = now_ns;
      tend(now_ns);
    }
    // only now: an event of this round may still have pointed to it
    if (any_dropped_) clients_.remove_if([](const Connection& connection) { return connection.dropped; });
    any_dropped_ = false;
  }
}

void Server::accept_waiting(std::int64_t now_ns) noexcept {
  for (int i = 0; i < accepted_at_once; ++i) {
    Descriptor socket(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!socket) {
      if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
        ++connections_.no_descriptor;
        watch_listener(false);  // it would wake us for nothing until the next tend()
      }
      return;
    }
    try {
      admit(std::move(socket), now_ns);
    } catch (const std::bad_alloc&) {
      ++connections_.no_descriptor;
    }
  }
}

void Server::admit(Descriptor socket, std::int64_t now_ns) {
  make_room();
  prepare(socket.get());
  Connection& client = clients_.emplace_back();
  client.socket = std::move(socket);
  client.id = next_client_++;
  client.last_heard_ns = now_ns;
  epoll_event event{.events = EPOLLIN, .data = {.ptr = &client}};
  if (epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, client.socket.get(), &event) != 0) drop(client);
  ++connections_.accepted;
}

void Server::make_room() noexcept {
  const auto live = std::ranges::count_if(clients_, [](const Connection& c) { return !c.dropped; });
  if (live < settings_.max_clients) return;
  Connection* longest_silent = nullptr;
  for (Connection& client : clients_) {
    if (client.dropped || responder_.in_command(client.id)) continue;
    if (longest_silent == nullptr || client.last_heard_ns < longest_silent->last_heard_ns) longest_silent = &client;
  }
  if (longest_silent == nullptr) return;
  ++connections_.replaced;
  drop(*longest_silent);
}

void Server::serve(Connection& client) noexcept {
  if (client.dropped) return;
  const auto received = recv(client.socket.get(), client.buffer.data() + client.used, client.buffer.size() - client.used, 0);
  if (received < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (received <= 0) return drop(client);
  const std::int64_t now_ns = monotonic_ns();
  if (client.used == 0) client.request_began_ns = now_ns;
  client.last_heard_ns = now_ns;
  client.used += static_cast<std::size_t>(received);
  if (!answer_all(client, now_ns)) drop(client);
}

bool Server::answer_all(Connection& client, std::int64_t arrival_ns) noexcept {
  std::span<const std::uint8_t> stream(client.buffer.data(), client.used);
  for (;;) {
    const Cut cut = cut_frame(stream);
    if (cut.malformed) {
      ++connections_.malformed;
      return false;
    }
    if (cut.bytes == 0) break;
    if (!responder_.answer(client.socket.get(), client.id, stream.first(cut.bytes), arrival_ns)) return false;
    stream = stream.subspan(cut.bytes);
    client.request_began_ns = arrival_ns;
  }
  if (stream.size() < client.used) std::ranges::copy(stream, client.buffer.begin());
  client.used = stream.size();
  return true;
}

void Server::tend(std::int64_t now_ns) noexcept {
  for (Connection& client : clients_) {
    if (client.dropped || client.used == 0 || now_ns - client.request_began_ns < settings_.request_time_ns) continue;
    ++connections_.slow;
    drop(client);
  }
  watch_listener(true);
}

void Server::drop(Connection& client) noexcept {
  client.dropped = any_dropped_ = true;
  responder_.leave(client.id);
  client.socket.reset();  // epoll forgets it by itself
}

}  // namespace feedtwin::io::modbus
