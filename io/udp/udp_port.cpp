#include "io/udp/udp_port.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "io/monotonic.h"

namespace feedtwin::io::udp {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

sockaddr_in address_of(const Peer& peer) noexcept FEEDTWIN_REALTIME {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = peer.address;
  address.sin_port = peer.port;
  return address;
}

/// What the kernel says beside a datagram: when it came (CLOCK_REALTIME) and how many were thrown away so far.
struct Aside {
  std::int64_t stamp_ns = 0;
  std::uint32_t dropped = 0;
};

Aside aside_of(msghdr& message) noexcept FEEDTWIN_REALTIME {
  Aside aside;
  FEEDTWIN_ADMIT_BEGIN  // CMSG_NXTHDR is a function of the C library that only adds up lengths
      for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level != SOL_SOCKET) continue;
    if (header->cmsg_type == SCM_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(header), sizeof stamp);
      aside.stamp_ns = stamp.tv_sec * ns_per_s + stamp.tv_nsec;
    } else if (header->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&aside.dropped, CMSG_DATA(header), sizeof aside.dropped);
    }
  }
  FEEDTWIN_ADMIT_END
  return aside;
}

/// The kernel stamps by the wall clock: what counts is how long ago that was. A step of that clock is cut off.
std::int64_t arrival_ns(std::int64_t stamp_ns) noexcept FEEDTWIN_REALTIME {
  const std::int64_t now_ns = monotonic_ns();
  if (stamp_ns == 0) return now_ns;
  return now_ns - std::clamp<std::int64_t>(clock_ns(CLOCK_REALTIME) - stamp_ns, 0, ns_per_s);
}

}  // namespace

UdpPort::UdpPort(const UdpSettings& settings, const PortContext& context)
    : settings_(settings),
      axes_(static_cast<std::size_t>(std::clamp(context.axes, 1, max_axes))),
      session_(settings.command_idle_ns) {}

void UdpPort::open() {
  if (socket_) return;
  const std::string where = "udp: " + settings_.address + ":" + std::to_string(settings_.port) + ": ";
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(settings_.port));
  if (inet_pton(AF_INET, settings_.address.c_str(), &address.sin_addr) != 1) throw PortError(where + "not an IPv4 address");
  Descriptor opened(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!opened || ::bind(opened.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw PortError(where + (errno == EADDRINUSE ? "already in use by another program" : std::strerror(errno)));
  for (const int option : {SO_TIMESTAMPNS, SO_RXQ_OVFL}) {
    const int on = 1;
    if (setsockopt(opened.get(), SOL_SOCKET, option, &on, sizeof on) != 0) throw PortError(where + std::strerror(errno));
  }
  socklen_t size = sizeof address;
  getsockname(opened.get(), reinterpret_cast<sockaddr*>(&address), &size);
  bound_port_ = ntohs(address.sin_port);
  socket_ = std::move(opened);
}

void UdpPort::close() noexcept {
  socket_.reset();
}

bool UdpPort::read_one(Datagram& datagram) noexcept {
  sockaddr_in from{};
  iovec part{.iov_base = buffer_.data(), .iov_len = buffer_.size()};
  alignas(cmsghdr) std::array<char, 128> control{};
  msghdr message{};
  message.msg_name = &from;
  message.msg_namelen = sizeof from;
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  ssize_t size = -1;
  {
    FEEDTWIN_ADMIT_BEGIN  // MSG_DONTWAIT: takes what is there and never sleeps
        size = ::recvmsg(socket_.get(), &message, MSG_DONTWAIT);
    FEEDTWIN_ADMIT_END
  }
  if (size < 0) return false;
  const Aside aside = aside_of(message);
  datagram.peer = {from.sin_addr.s_addr, from.sin_port};
  datagram.size = static_cast<std::size_t>(size);
  datagram.arrival_ns = arrival_ns(aside.stamp_ns);
  overflowed_ += aside.dropped - std::min<std::uint64_t>(aside.dropped, overflowed_.value());
  ++received_;
  return true;
}

Session::Verdict UdpPort::accept(const Datagram& datagram) noexcept {
  Request request;
  if (!decode({buffer_.data(), datagram.size}, axes_, request)) {
    ++malformed_;
    return Session::Verdict::refused;
  }
  const std::uint64_t lost = session_.lost();
  const auto verdict = session_.judge(datagram.peer, request.sequence, datagram.arrival_ns);
  switch (verdict) {
    case Session::Verdict::use:
      pending_ = request;
      pending_arrival_ns_ = datagram.arrival_ns;
      have_pending_ = true;
      lost_ += session_.lost() - lost;
      break;
    case Session::Verdict::duplicate:
      ++duplicates_;
      break;
    case Session::Verdict::late:
      ++late_;
      break;
    case Session::Verdict::refused:
      ++refused_;
      break;
  }
  return verdict;
}

std::uint64_t UdpPort::hand_over(std::span<AxisRequest> newest, std::uint64_t unseen) noexcept {
  std::uint64_t fresh = 0;
  for (std::size_t i = 0; i < std::min(pending_.axes, newest.size()); ++i) {
    const bool replaces = ((unseen >> i) & 1U) != 0;
    newest[i] = replaces ? replacing(newest[i], pending_.axis[i]) : pending_.axis[i];
    newest[i].sequence = session_.sequence();
    newest[i].arrival_ns = pending_arrival_ns_;
    fresh |= std::uint64_t{1} << i;
  }
  have_pending_ = false;
  reply_due_ = machine_due_ = true;
  return fresh;
}

bool UdpPort::receive_machine(MachineRequest& newest) noexcept {
  if (!machine_due_) return false;
  machine_due_ = false;
  newest = pending_.machine;
  return true;
}

std::uint64_t UdpPort::receive(std::span<AxisRequest> newest) noexcept {
  if (have_pending_) return hand_over(newest, 0);  // lockstep: this one datagram makes this tick
  std::uint64_t fresh = 0;
  Datagram datagram;
  for (int i = 0; i < most_datagrams && read_one(datagram); ++i) {
    if (accept(datagram) != Session::Verdict::use) continue;
    if (fresh != 0) ++superseded_;
    fresh |= hand_over(newest, fresh);
  }
  return fresh;
}

bool UdpPort::wait_for_request(std::int64_t until_ns) noexcept {
  while (!have_pending_) {
    Datagram datagram;
    const bool came = read_one(datagram);
    // a duplicate: its reply was lost, so say again what came of it
    if (came && accept(datagram) == Session::Verdict::duplicate && send_reply()) ++repeated_replies_;
    if (have_pending_) break;
    const std::int64_t left_ns = until_ns - monotonic_ns();
    if (left_ns <= 0) return false;
    if (came) continue;
    pollfd waiting{.fd = socket_.get(), .events = POLLIN, .revents = 0};
    const timespec timeout{.tv_sec = left_ns / ns_per_s, .tv_nsec = left_ns % ns_per_s};
    if (::ppoll(&waiting, 1, &timeout, nullptr) < 0) return false;  // a signal: the caller may want to stop
  }
  return true;
}

bool UdpPort::send_reply() noexcept {
  if (reply_bytes_ == 0) return false;
  const sockaddr_in to = address_of(session_.commander());
  ssize_t sent = -1;
  {
    FEEDTWIN_ADMIT_BEGIN  // MSG_DONTWAIT: queues the datagram or gives up
        sent = ::sendto(socket_.get(), reply_.data(), reply_bytes_, MSG_DONTWAIT | MSG_NOSIGNAL,
                        reinterpret_cast<const sockaddr*>(&to), sizeof to);
    FEEDTWIN_ADMIT_END
  }
  if (sent < 0) ++unsent_;
  return sent >= 0;
}

void UdpPort::send(const TickReport& tick, std::span<const AxisReport> axes) noexcept {
  if (!reply_due_) return;
  reply_due_ = false;
  reply_bytes_ = encode({.sequence = session_.wire_sequence(), .stamp = pending_.stamp, .tick = tick}, axes, reply_);
  send_reply();
}

std::vector<Counter> UdpPort::counters() const {
  return {
      {"udp_datagrams", "datagrams read", received_.value()},
      {"udp_malformed", "datagrams that are no request for this plant", malformed_.value()},
      {"udp_refused", "requests from somebody who was not in command", refused_.value()},
      {"udp_duplicates", "requests seen before, not used again", duplicates_.value()},
      {"udp_late", "requests overtaken by a later one, not used", late_.value()},
      {"udp_lost", "sequence numbers skipped by the controller or the network", lost_.value()},
      {"udp_superseded", "requests that another one replaced within the tick", superseded_.value()},
      {"udp_overflowed", "datagrams that the kernel had no room for", overflowed_.value()},
      {"udp_repeated_replies", "replies sent again for a repeated request", repeated_replies_.value()},
      {"udp_unsent", "replies that could not be sent", unsent_.value()},
  };
}

std::unique_ptr<Port> make_udp_port(Settings& settings, const PortContext& context) {
  UdpSettings s;
  s.address = settings.text("address", s.address);
  if (in_addr parsed{}; inet_pton(AF_INET, s.address.c_str(), &parsed) != 1)
    settings.fail("address", "expected an IPv4 address, found \"" + s.address + "\"");
  s.port = static_cast<int>(settings.integer("port", 0, 65535, s.port));
  s.command_idle_ns = static_cast<std::int64_t>(settings.number("command_idle_s", 0.01, 3600.0, 1.0) * 1e9);
  return std::make_unique<UdpPort>(s, context);
}

}  // namespace feedtwin::io::udp
