#include "io/can/socketcan_link.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "io/can/bus_restart.h"
#include "io/monotonic.h"

namespace feedtwin::io::can {
namespace {

void set_option(int socket, int level, int option, const void* value, socklen_t size, const char* what) {
  if (::setsockopt(socket, level, option, value, size) != 0) {
    throw PortError(std::string("can't set ") + what + ": " + std::strerror(errno));
  }
}

}  // namespace

void SocketCanLink::open() {
  const auto failed = [this](const std::string& what) {
    return PortError(settings_.interface + ": " + what + ": " + std::strerror(errno));
  };
  interface_index_ = static_cast<int>(::if_nametoindex(settings_.interface.c_str()));
  if (interface_index_ == 0) throw failed("no such CAN interface (ip link add dev vcan0 type vcan makes a virtual one)");
  socket_ = Descriptor(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (!socket_) throw failed("can't open a CAN socket");
  wake_ = Descriptor(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  if (!wake_) throw failed("can't make an event counter");
  const int on = 1;
  const can_err_mask_t errors = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED | CAN_ERR_CRTL | CAN_ERR_ACK | CAN_ERR_TX_TIMEOUT;
  set_option(socket_.get(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors, "the error filter");
  set_option(socket_.get(), SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on, "receive time stamps");
  set_option(socket_.get(), SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on, "the counter of dropped frames");
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = interface_index_;
  if (::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) throw failed("can't bind");
}

void SocketCanLink::close() noexcept {
  socket_.reset();
  wake_.reset();
}

void SocketCanLink::listen(std::span<const std::uint16_t> ids) noexcept {
  std::vector<can_filter> filters;
  for (const auto id : ids) {
    if (id <= CAN_SFF_MASK) filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG});  // remote frames pass as well
  }
  const auto size = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
  if (::setsockopt(socket_.get(), SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), size) != 0) ++filter_errors_;
}

std::int64_t SocketCanLink::now_ns() noexcept FEEDTWIN_REALTIME {
  return monotonic_ns();
}

bool SocketCanLink::take_recovery() noexcept FEEDTWIN_REALTIME {
  const bool recovered = recovered_;
  recovered_ = false;
  return recovered;
}

bool SocketCanLink::receive(ReceivedFrame& received) noexcept FEEDTWIN_REALTIME {
  while (true) {  // ends: every turn takes a frame from a queue that the kernel bounds
    can_frame raw{};
    iovec part{&raw, sizeof raw};
    alignas(cmsghdr) std::array<char, 128> control{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    ssize_t got = 0;
    {
      FEEDTWIN_ADMIT_BEGIN  // a non-blocking socket: returns at once
          got = ::recvmsg(socket_.get(), &message, MSG_DONTWAIT);
      FEEDTWIN_ADMIT_END
    }
    if (got != static_cast<ssize_t>(sizeof raw)) return false;
    received.arrival_ns = monotonic_ns() - read_ancillary(message);
    if ((raw.can_id & CAN_ERR_FLAG) != 0) {
      error_frame(raw.can_id & CAN_ERR_MASK);
      continue;
    }
    if ((raw.can_id & CAN_EFF_FLAG) != 0 || raw.can_dlc > CAN_MAX_DLEN) {
      ++foreign_;
      continue;
    }
    received.frame.id = static_cast<std::uint16_t>(raw.can_id & CAN_SFF_MASK);
    received.frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
    received.frame.length = raw.can_dlc;
    received.frame.data = {};
    if (!received.frame.remote) std::memcpy(received.frame.data.data(), raw.data, raw.can_dlc);
    return true;
  }
}

/// What the kernel says beside a frame: its drops so far, which are counted, and when the frame came.
/// @return how long ago that was, in ns; 0 where it does not say
std::int64_t SocketCanLink::read_ancillary(msghdr& message) noexcept FEEDTWIN_REALTIME {
  std::int64_t ago_ns = 0;
  FEEDTWIN_ADMIT_BEGIN  // CMSG_NXTHDR is a function of the C library that only counts up a pointer
      for (cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr; c = CMSG_NXTHDR(&message, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SO_TIMESTAMPNS) {  // in CLOCK_REALTIME; what counts is the distance to now
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
      ago_ns = clock_ns(CLOCK_REALTIME) - (static_cast<std::int64_t>(stamp.tv_sec) * 1'000'000'000 + stamp.tv_nsec);
    } else if (c->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t drops = 0;
      std::memcpy(&drops, CMSG_DATA(c), sizeof drops);
      dropped_ += drops - kernel_drops_;
      kernel_drops_ = drops;
    }
  }
  FEEDTWIN_ADMIT_END
  return ago_ns > 0 && ago_ns < 1'000'000'000 ? ago_ns : 0;  // otherwise the clock was set
}

void SocketCanLink::error_frame(std::uint32_t classes) noexcept FEEDTWIN_REALTIME {
  ++error_frames_;
  if ((classes & CAN_ERR_BUSOFF) != 0) {
    ++bus_offs_;
    bus_off_.store(true, std::memory_order_relaxed);
  }
  if ((classes & CAN_ERR_RESTARTED) != 0) {
    recovered_ = bus_off_.exchange(false, std::memory_order_relaxed);
  }
}

Sent SocketCanLink::send(const Frame& frame) noexcept FEEDTWIN_REALTIME {
  can_frame raw{};
  raw.can_id = frame.id | (frame.remote ? CAN_RTR_FLAG : 0U);
  raw.can_dlc = frame.length;
  std::memcpy(raw.data, frame.data.data(), frame.length);
  ssize_t put = 0;
  int error = 0;
  {
    FEEDTWIN_ADMIT_BEGIN  // a non-blocking socket: returns at once
        put = ::send(socket_.get(), &raw, sizeof raw, MSG_DONTWAIT);
    error = errno;
    FEEDTWIN_ADMIT_END
  }
  if (put == static_cast<ssize_t>(sizeof raw)) return Sent::yes;
  if (error == ENOBUFS || error == EAGAIN) {  // the interface's or the socket's queue is full for the moment
    if (bus_off_.load(std::memory_order_relaxed)) return Sent::lost;
    ++no_room_;
    return Sent::later;
  }
  ++send_errors_;  // the interface is down or gone
  return Sent::lost;
}

bool SocketCanLink::wait(std::int64_t until_ns, WakeUp by) noexcept {
  std::array<pollfd, 2> waiting{pollfd{wake_.get(), POLLIN, 0}, pollfd{socket_.get(), POLLIN, 0}};
  const std::int64_t left_ns = std::max<std::int64_t>(until_ns - monotonic_ns(), 0);
  const timespec left{static_cast<time_t>(left_ns / 1'000'000'000), static_cast<long>(left_ns % 1'000'000'000)};
  if (::ppoll(waiting.data(), by == WakeUp::frame ? 2 : 1, &left, nullptr) <= 0) return false;
  std::uint64_t calls = 0;
  if (waiting[0].revents != 0) (void)!::read(wake_.get(), &calls, sizeof calls);  // non-blocking: back to none
  return true;
}

void SocketCanLink::wake() noexcept FEEDTWIN_REALTIME {
  const std::uint64_t once = 1;
  FEEDTWIN_ADMIT_BEGIN  // a non-blocking counter: at most wakes a thread
      (void) !::write(wake_.get(), &once, sizeof once);
  FEEDTWIN_ADMIT_END
}

void SocketCanLink::supervise(std::int64_t now_ns) noexcept {
  if (!bus_off_.load(std::memory_order_relaxed)) {
    off_since_ns_ = 0;
    return;
  }
  if (off_since_ns_ == 0) off_since_ns_ = now_ns;
  if (settings_.restart_ms == 0 || now_ns - off_since_ns_ < std::int64_t{settings_.restart_ms} * 1'000'000) return;
  off_since_ns_ = now_ns;  // again after as long if it stays off
  if (restart_bus(interface_index_)) ++restarts_;
}

void SocketCanLink::add_counters(std::vector<Counter>& counters) const {
  const auto add = [&](const char* name, const char* meaning, const Tally& tally, bool loses_data) {
    counters.push_back({name, meaning, tally.value(), loses_data});
  };
  add("kernel_drops", "frames that the kernel dropped because its queue was full", dropped_, true);
  add("bus_off", "times that the controller went off the bus", bus_offs_, true);
  add("bus_restarts", "restarts of the controller asked for after bus-off", restarts_, false);
  add("error_frames", "error frames from the controller", error_frames_, false);
  add("no_room", "frames that found the interface's queue full (ENOBUFS)", no_room_, false);
  add("send_errors", "frames refused because the interface is down", send_errors_, true);
  add("foreign", "frames with extended identifiers", foreign_, false);
  add("filter_errors", "filters that the kernel refused", filter_errors_, true);
}

}  // namespace feedtwin::io::can
