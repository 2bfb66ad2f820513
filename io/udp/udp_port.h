#pragma once
// The plant over UDP (datagram.h): the socket is served by the tick itself, with calls that never block, so that a reply
// leaves in the tick that made it. Free-running, or stepped by the controller's datagrams (lockstep).

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/descriptor.h"
#include "io/port.h"
#include "io/registry.h"
#include "io/tally.h"
#include "io/udp/datagram.h"
#include "io/udp/session.h"

namespace feedtwin::io::udp {

struct UdpSettings {
  std::string address = "127.0.0.1";
  int port = 47110;  ///< 0: one that is free
  std::int64_t command_idle_ns = 1'000'000'000;
};

class UdpPort final : public Port {
 public:
  UdpPort(const UdpSettings& settings, const PortContext& context);

  [[nodiscard]] std::string_view name() const noexcept override { return "udp"; }
  void open() override;
  void close() noexcept override;
  /// At most most_datagrams are read; a system call or two.
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME override;
  bool receive_machine(MachineRequest& newest) noexcept FEEDTWIN_REALTIME override;
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME override;
  bool wait_for_request(std::int64_t until_ns) noexcept override;
  [[nodiscard]] bool can_step_the_plant() const noexcept override { return true; }
  [[nodiscard]] std::vector<Counter> counters() const override;

  /// The UDP port that is served; 0 before open().
  [[nodiscard]] int udp_port() const noexcept { return bound_port_; }

  static constexpr int most_datagrams = 32;

 private:
  struct Datagram {
    Peer peer;
    std::size_t size = 0;
    std::int64_t arrival_ns = 0;
  };
  /// The next datagram into buffer_. @return false if there is none
  bool read_one(Datagram& datagram) noexcept FEEDTWIN_REALTIME;
  /// Into pending_, if it is to be used.
  Session::Verdict accept(const Datagram& datagram) noexcept FEEDTWIN_REALTIME;
  /// pending_ into the requests. @param unseen a bit for each axis whose request there is not older than this tick
  std::uint64_t hand_over(std::span<AxisRequest> newest, std::uint64_t unseen) noexcept FEEDTWIN_REALTIME;
  bool send_reply() noexcept FEEDTWIN_REALTIME;

  UdpSettings settings_;
  std::size_t axes_;
  Descriptor socket_;
  int bound_port_ = 0;
  Session session_;
  Request pending_;
  std::int64_t pending_arrival_ns_ = 0;
  bool have_pending_ = false, reply_due_ = false, machine_due_ = false;
  // one byte more than the largest request, so that a longer datagram does not look like one
  std::array<std::uint8_t, largest_request_bytes + 1> buffer_{};
  std::array<std::uint8_t, largest_reply_bytes> reply_{};
  std::size_t reply_bytes_ = 0;
  Tally received_, malformed_, duplicates_, late_, lost_, refused_, superseded_, unsent_, repeated_replies_, overflowed_;
};

std::unique_ptr<Port> make_udp_port(Settings& settings, const PortContext& context);

}  // namespace feedtwin::io::udp
