#pragma once
// The port of a CAN bus: one device an axis, frames through a link.
//
// Free-running, a thread of its own serves the bus, as a drive's communication processor does: a SYNC is answered at once
// with the state that the last tick ended with (object 2004 says which tick that was), and the torque that it latched acts
// from the next tick on. In lockstep, and on a simulated bus, the tick serves the bus itself.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "io/can/bus_nodes.h"
#include "io/mailbox.h"
#include "io/real_time_thread.h"
#include "io/registry.h"
#include "io/request_exchange.h"

namespace feedtwin::io::can {

struct CanPortSettings {
  bool supervised = false;       ///< filters follow the nodes' mappings, and a bus that is off is restarted
  bool answers_at_once = false;  ///< by a thread of its own; false: in the tick
  int priority = 76;             ///< of that thread, SCHED_FIFO, below the plant's; 0: none
};

class CanPort final : public Port {
 public:
  /// @param devices one an axis
  CanPort(std::unique_ptr<Link> link, std::vector<std::unique_ptr<Device>> devices, const CanPortSettings& settings);
  ~CanPort() override { CanPort::close(); }

  [[nodiscard]] std::string_view name() const noexcept override { return "can"; }
  void open() override;
  void close() noexcept override;
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME override;
  bool receive_machine(MachineRequest& newest) noexcept FEEDTWIN_REALTIME override;
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME override;
  bool wait_for_request(std::int64_t until_ns) noexcept override;
  [[nodiscard]] bool can_step_the_plant() const noexcept override { return !settings_.answers_at_once; }
  bool break_encoder(EncoderFault fault, int axis, bool on, std::int64_t amount) noexcept FEEDTWIN_REALTIME override;
  /// After close(), where a thread of its own serves the bus.
  [[nodiscard]] std::vector<Counter> counters() const override;
  [[nodiscard]] std::vector<PortEvent> take_events() override { return rank_.refusal("CAN thread"); }

  [[nodiscard]] const BusCounters& totals() const noexcept { return nodes_.totals(); }
  /// Enabled requests that came while another port commands.
  [[nodiscard]] std::uint64_t not_in_command() const noexcept { return not_in_command_; }

 private:
  /// What the tick tells the thread that serves the bus.
  struct Reports {
    std::array<AxisReport, max_axes> axis{};
    std::size_t axes = 0;
  };
  void run(const std::stop_token& stop) noexcept;
  /// One turn of that thread.
  void serve() noexcept FEEDTWIN_REALTIME;
  void pass_on_requests() noexcept FEEDTWIN_REALTIME;
  /// Answers the bus where another port commands and nobody asks this one.
  void serve_unasked() noexcept FEEDTWIN_REALTIME;
  void supervise(const std::stop_token& stop);

  CanPortSettings settings_;
  BusNodes nodes_;
  bool sent_before_ = false;
  bool asked_ = false;     ///< since the last send()
  bool lockstep_ = false;  ///< the loop waits for us: frames are taken there, one step of the plant at a time
  std::uint64_t not_in_command_ = 0;
  // between the tick and the thread
  RequestExchange requests_;
  Mailbox<Reports> reports_;
  std::atomic<std::uint64_t> failed_encoders_{0};  ///< a bit an axis
  RealTimeRank rank_;
  std::jthread supervisor_, server_;
};

/// Kind `can`. Keys: interface, personality, node_id, ... as in systemd/examples/can.toml.
[[nodiscard]] std::unique_ptr<Port> make_can_port(Settings& settings, const PortContext& context);

}  // namespace feedtwin::io::can
