#include "tools/latency/udp_probe.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <random>

#include "io/monotonic.h"
#include "io/udp/datagram.h"
#include "tools/config/input_error.h"

namespace feedtwin::tools {
namespace {

constexpr std::size_t request_bytes = io::udp::request_header_bytes + io::udp::request_axis_bytes;

/// One axis, no torque, enabled; layout in io/udp/datagram.h.
std::array<unsigned char, request_bytes> request(std::uint32_t sequence) {
  std::array<unsigned char, request_bytes> bytes{'F', 'T', 'W', 'N', 1, 1, 1, 0};
  const std::uint64_t stamp = sequence;
  const std::uint16_t enable = 1;
  std::memcpy(&bytes[8], &sequence, sizeof sequence);
  std::memcpy(&bytes[16], &stamp, sizeof stamp);
  std::memcpy(&bytes[32], &enable, sizeof enable);
  return bytes;
}

int connected_socket(int udp_port) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(static_cast<std::uint16_t>(udp_port));
  const timeval limit{.tv_sec = 0, .tv_usec = 100'000};
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  if (socket < 0 || ::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
    throw InputError(std::string("latency probe: ") + std::strerror(errno));
  }
  return socket;
}

}  // namespace

UdpProbe::UdpProbe(int udp_port, double tick_s, const rt::RtSettings& tick_settings) {
  const int socket = connected_socket(udp_port);
  rt::RtSettings own = tick_settings;
  own.priority = tick_settings.priority > 1 ? tick_settings.priority - 1 : 0;
  own.cpu = -1;
  thread_ = std::thread([this, socket, tick_s, own] {
    (void)rt::make_thread_real_time(own);  // where it is denied the probe measures all the same
    measure(socket, tick_s);
    ::close(socket);
  });
}

UdpProbe::~UdpProbe() {
  stop();
}

void UdpProbe::stop() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
}

void UdpProbe::measure(int socket, double tick_s) {
  std::mt19937 random(1);  // NOLINT(bugprone-random-generator-seed): the same pauses in every run
  std::uniform_real_distribution<double> pause_s(0.0, tick_s);
  std::array<unsigned char, io::udp::largest_reply_bytes> reply{};
  for (std::uint32_t sequence = 1; !stop_.load(std::memory_order_relaxed); ++sequence) {
    std::this_thread::sleep_for(std::chrono::duration<double>(pause_s(random)));
    const auto bytes = request(sequence);
    const std::int64_t sent_ns = io::monotonic_ns();
    bool answered = ::send(socket, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
    for (std::uint32_t echoed = 0; answered && echoed != sequence;) {
      answered = ::recv(socket, reply.data(), reply.size(), 0) >= static_cast<ssize_t>(io::udp::reply_header_bytes);
      std::memcpy(&echoed, &reply[8], sizeof echoed);
    }
    if (answered) {
      histogram_.record(io::monotonic_ns() - sent_ns);
    } else if (!stop_.load(std::memory_order_relaxed)) {
      ++unanswered_;
    }
  }
}

}  // namespace feedtwin::tools
