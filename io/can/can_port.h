#pragma once
// The port of a CAN bus: one device an axis, frames through a link.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "io/can/device.h"
#include "io/can/link.h"
#include "io/registry.h"

namespace feedtwin::io::can {

struct CanPortCounters {
  std::uint64_t received = 0, sent = 0;
  std::uint64_t left_for_next_tick = 0;  ///< ticks that ended their drain at the bound
  std::uint64_t delayed = 0;             ///< ticks in which the adapter had no room (ENOBUFS): sent later
  std::uint64_t replaced = 0;            ///< cyclic frames that waited and were overtaken by a newer one
  std::uint64_t lost = 0;                ///< frames that could not be sent, bus off or queue full
  std::uint64_t recoveries = 0;          ///< times that the bus came back
  std::uint64_t not_in_command = 0;      ///< enabled requests that came while another port commands: not used
};

class CanPort final : public Port {
 public:
  /// Frames taken from the bus in one tick, at most.
  static constexpr int most_frames = 128;

  /// @param devices one an axis
  CanPort(std::unique_ptr<Link> link, std::vector<std::unique_ptr<Device>> devices, bool supervised);
  ~CanPort() override { CanPort::close(); }

  [[nodiscard]] std::string_view name() const noexcept override { return "can"; }
  void open() override;
  void close() noexcept override;
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME override;
  bool receive_machine(MachineRequest& newest) noexcept FEEDTWIN_REALTIME override {
    return !devices_.empty() && devices_.front()->take_machine_request(newest);
  }
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME override;
  bool wait_for_request(std::int64_t until_ns) noexcept override;
  [[nodiscard]] bool can_step_the_plant() const noexcept override { return true; }
  bool break_encoder(EncoderFault fault, int axis, bool on, std::int64_t amount) noexcept FEEDTWIN_REALTIME override;
  [[nodiscard]] std::vector<Counter> counters() const override;

  [[nodiscard]] const CanPortCounters& totals() const noexcept { return counters_; }

 private:
  /// Take frames from the link until there are none, `most_frames` are reached or a step of the plant is due.
  bool drain() noexcept FEEDTWIN_REALTIME;
  /// Answers the bus where another port commands and nobody asks this one.
  void serve_unasked() noexcept FEEDTWIN_REALTIME;
  void flush() noexcept FEEDTWIN_REALTIME;
  void enqueue() noexcept FEEDTWIN_REALTIME;
  void supervise(const std::stop_token& stop);
  void gather_ids(std::vector<std::uint16_t>& ids) const;

  std::unique_ptr<Link> link_;
  std::vector<std::unique_ptr<Device>> devices_;
  bool supervised_;
  bool started_ = false;
  bool sent_before_ = false;
  bool asked_ = false;            ///< since the last send()
  bool lockstep_ = false;         ///< the loop waits for us: frames are taken there, one step of the plant at a time
  std::int64_t trigger_ns_ = -1;  ///< arrival of the frame that asked for a reply in this drain
  std::int64_t reply_ns_ = -1;    ///< from there to the reply's leaving
  FrameQueue fresh_;              ///< what the devices say
  FrameQueue waiting_;            ///< for room in the adapter
  CanPortCounters counters_;
  std::jthread supervisor_;
};

/// Kind `can`. Keys: interface, personality, node_id, ... as in systemd/examples/can.toml.
[[nodiscard]] std::unique_ptr<Port> make_can_port(Settings& settings, const PortContext& context);

}  // namespace feedtwin::io::can
