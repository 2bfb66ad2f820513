#pragma once
// One axis that speaks ODrive's CAN Simple in torque control: identifier = node << 5 | command. Pure: no clock, no socket.

#include <cstdint>

#include "io/can/device.h"
#include "io/can/heartbeat.h"
#include "io/can/pending_request.h"

namespace feedtwin::io::can {

struct OdriveSettings {
  std::uint8_t node_id = 0;  ///< 0..63
  double encoder_counts_per_rev = 65536.0;
  double lead_m = 0.005;
  double rated_torque_Nm = 1.27;
  int heartbeat_ms = 100;
  int encoder_ms = 1;     ///< period of the encoder estimates; 0: only when asked for
  int watchdog_ms = 100;  ///< closed loop without a torque command for longer is an error; 0: never
};

struct OdriveCounters {
  std::uint64_t commands = 0;  ///< torque commands used
  std::uint64_t refused = 0;   ///< not finite, too short, or not in closed loop
  std::uint64_t unknown = 0;   ///< frames of a command that is not served
  std::uint64_t watchdog = 0;  ///< times that the watchdog acted
};

class OdriveNode final : public Device {
 public:
  explicit OdriveNode(const OdriveSettings& settings) noexcept : settings_(settings) {}

  void start(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  void accept(const Frame& frame, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  void report(const AxisReport& axis, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  bool take_request(AxisRequest& newest) noexcept FEEDTWIN_REALTIME override;
  void bus_recovered(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  void encoder_failed(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  [[nodiscard]] bool steps_the_plant(const Frame& frame) const noexcept FEEDTWIN_REALTIME override;
  void listens_to(std::span<std::uint16_t, most_ids> ids) const noexcept override;
  void add_counters(const std::string& prefix, std::vector<Counter>& counters) const override;

  [[nodiscard]] std::uint32_t errors() const noexcept { return errors_; }
  [[nodiscard]] bool closed_loop() const noexcept { return closed_loop_; }
  [[nodiscard]] const OdriveCounters& counters() const noexcept { return counters_; }

 private:
  void command(int command, const Frame& frame, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME;
  void answer(int command, FrameQueue& out) const noexcept FEEDTWIN_REALTIME;
  void set_state(std::uint32_t state, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME;
  void set_torque(const Frame& frame, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME;
  void fail(std::uint32_t error) noexcept FEEDTWIN_REALTIME;

  OdriveSettings settings_;
  AxisReport axis_;
  PendingRequest pending_;
  std::uint32_t errors_ = 0;
  bool closed_loop_ = false, torque_control_ = true;
  float torque_Nm_ = 0.0F;
  HeartbeatProducer heartbeat_, encoder_;
  OdriveCounters counters_;
};

}  // namespace feedtwin::io::can
