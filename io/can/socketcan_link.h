#pragma once
// SocketCAN: raw frames through a Linux CAN interface.

#include <sys/socket.h>

#include <atomic>
#include <string>

#include "io/can/link.h"
#include "io/descriptor.h"
#include "io/tally.h"

namespace feedtwin::io::can {

struct SocketCanSettings {
  std::string interface = "vcan0";
  int restart_ms = 100;  ///< after bus-off; 0: left to the interface's own restart-ms
};

/// Non-blocking; kernel filters; the kernel's receive time stamps; error frames tell of bus-off.
class SocketCanLink final : public Link {
 public:
  explicit SocketCanLink(SocketCanSettings settings) : settings_(std::move(settings)) {}

  void open() override;
  void close() noexcept override;
  bool receive(ReceivedFrame& frame) noexcept FEEDTWIN_REALTIME override;
  Sent send(const Frame& frame) noexcept FEEDTWIN_REALTIME override;
  [[nodiscard]] std::int64_t now_ns() noexcept FEEDTWIN_REALTIME override;
  bool take_recovery() noexcept FEEDTWIN_REALTIME override;
  bool wait(std::int64_t until_ns, WakeUp by) noexcept override;
  void wake() noexcept FEEDTWIN_REALTIME override;
  void listen(std::span<const std::uint16_t> ids) noexcept override;
  void supervise(std::int64_t now_ns) noexcept override;
  void add_counters(std::vector<Counter>& counters) const override;

 private:
  std::int64_t read_ancillary(msghdr& message) noexcept FEEDTWIN_REALTIME;
  void error_frame(std::uint32_t classes) noexcept FEEDTWIN_REALTIME;

  SocketCanSettings settings_;
  Descriptor socket_, wake_;
  int interface_index_ = 0;
  std::atomic<bool> bus_off_{false};
  bool recovered_ = false;
  std::int64_t off_since_ns_ = 0;  // the supervising thread's
  std::uint32_t kernel_drops_ = 0;
  Tally error_frames_, bus_offs_, no_room_, send_errors_, dropped_, foreign_, restarts_, filter_errors_;
};

}  // namespace feedtwin::io::can
