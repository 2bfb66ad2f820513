#pragma once
// One axis as a node on the bus, whatever language it speaks. Frames and time in, frames and requests out; no socket.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/can/frame.h"
#include "io/port.h"

namespace feedtwin::io::can {

class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  static constexpr std::size_t most_ids = 16;

  /// Says that it is there.
  virtual void start(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME = 0;
  /// A frame from the bus; answers go to `out`. Bounded, no allocation.
  virtual void accept(const Frame& frame, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME = 0;
  /// The axis at the end of a tick. Bounded, no allocation.
  virtual void report(const AxisReport& axis, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME = 0;
  /// What the controller wants since the last call. @return false if nothing has changed.
  virtual bool take_request(AxisRequest& newest) noexcept FEEDTWIN_REALTIME = 0;
  /// The same for the machine that the first axis belongs to.
  virtual bool take_machine_request(MachineRequest& /*newest*/) noexcept FEEDTWIN_REALTIME { return false; }
  /// The adapter was off the bus and is back.
  virtual void bus_recovered(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME = 0;
  /// The encoder is found to be broken.
  virtual void encoder_failed(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME = 0;
  /// True for a frame at which a plant in lockstep takes its next step.
  [[nodiscard]] virtual bool steps_the_plant(const Frame& frame) const noexcept FEEDTWIN_REALTIME = 0;

  /// The identifiers that it listens to, 0xFFFF where there is none. From any thread.
  virtual void listens_to(std::span<std::uint16_t, most_ids> ids) const noexcept = 0;
  /// Not on the tick. Names start with `prefix`.
  virtual void add_counters(const std::string& prefix, std::vector<Counter>& counters) const = 0;
};

}  // namespace feedtwin::io::can
