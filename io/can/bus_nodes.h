#pragma once
// The nodes of one bus and the way of their frames through a link. One thread at a time; no clock and no thread of its own.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "io/can/device.h"
#include "io/can/link.h"

namespace feedtwin::io::can {

struct BusCounters {
  std::uint64_t received = 0, sent = 0;
  std::uint64_t left_for_next_tick = 0;  ///< ticks that ended their drain at the bound
  std::uint64_t delayed = 0;             ///< ticks in which the adapter had no room (ENOBUFS): sent later
  std::uint64_t replaced = 0;            ///< cyclic frames that waited and were overtaken by a newer one
  std::uint64_t lost = 0;                ///< frames that could not be sent, bus off or queue full
  std::uint64_t recoveries = 0;          ///< times that the bus came back
};

class BusNodes {
 public:
  /// Frames taken from the bus in one tick, at most.
  static constexpr int most_frames = 128;

  /// @param devices one an axis
  BusNodes(std::unique_ptr<Link> link, std::vector<std::unique_ptr<Device>> devices);

  /// Take frames from the link and answer them, until there are none or the allowance is used up.
  /// @param to_the_step no further than a frame that steps the plant
  /// @return true if such a frame came
  bool drain(bool to_the_step) noexcept FEEDTWIN_REALTIME;
  /// False: this tick has had its most frames, and drain() leaves the rest until the next report() or renew_allowance().
  [[nodiscard]] bool may_take_more() const noexcept FEEDTWIN_REALTIME { return allowance_ > 0; }
  void renew_allowance() noexcept FEEDTWIN_REALTIME { allowance_ = most_frames; }
  /// The axes at the end of a tick.
  void report(std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME;
  /// What the controller wants of an axis since the last call. @return false if nothing has changed
  bool take_request(std::size_t axis, AxisRequest& newest) noexcept FEEDTWIN_REALTIME;
  bool take_machine_request(MachineRequest& newest) noexcept FEEDTWIN_REALTIME;
  void encoder_failed(std::size_t axis) noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] std::size_t size() const noexcept { return devices_.size(); }
  [[nodiscard]] Link& link() noexcept { return *link_; }
  /// What the nodes listen to, in order, each once. From any thread.
  void gather_ids(std::vector<std::uint16_t>& ids) const;
  [[nodiscard]] const BusCounters& totals() const noexcept { return counters_; }
  void add_counters(std::vector<Counter>& counters) const;

 private:
  void start() noexcept FEEDTWIN_REALTIME;
  void flush() noexcept FEEDTWIN_REALTIME;
  void enqueue() noexcept FEEDTWIN_REALTIME;

  std::unique_ptr<Link> link_;
  std::vector<std::unique_ptr<Device>> devices_;
  bool started_ = false;
  int allowance_ = most_frames;   ///< of frames in this tick
  std::int64_t trigger_ns_ = -1;  ///< arrival of the frame that asked for a reply in this drain
  std::int64_t reply_ns_ = -1;    ///< from there to the reply's leaving
  FrameQueue fresh_;              ///< what the devices say
  FrameQueue waiting_;            ///< for room in the adapter
  BusCounters counters_;
};

}  // namespace feedtwin::io::can
