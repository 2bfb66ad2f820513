#pragma once
// Any port with faults on purpose: a timed list of them, worked into the commands and the encoder, said as they happen.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/faults/command_fault.h"
#include "io/faults/count_fault.h"
#include "io/faults/fault.h"
#include "io/registry.h"

namespace feedtwin::io::faults {

class FaultPort final : public Port {
 public:
  /// @param inner must outlive this
  FaultPort(Port& inner, const std::vector<Fault>& faults, const PortContext& context);
  /// The same with a port of its own.
  FaultPort(std::unique_ptr<Port> inner, const std::vector<Fault>& faults, const PortContext& context);

  [[nodiscard]] std::string_view name() const noexcept override { return inner_.name(); }
  void open() override { inner_.open(); }
  void close() noexcept override { inner_.close(); }
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME override;
  bool receive_machine(MachineRequest& newest) noexcept FEEDTWIN_REALTIME override { return inner_.receive_machine(newest); }
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME override;
  bool wait_for_request(std::int64_t until_ns) noexcept override { return inner_.wait_for_request(until_ns); }
  [[nodiscard]] bool can_step_the_plant() const noexcept override { return inner_.can_step_the_plant(); }
  [[nodiscard]] std::vector<Counter> counters() const override;
  [[nodiscard]] std::vector<PortEvent> take_events() override;

 private:
  struct Happening {
    double time_s = 0.0;
    std::size_t fault = 0;
    bool begins = false;
  };
  struct Timed {
    Fault fault;
    bool active = false, over = false;
  };
  void advance(double now_s) noexcept FEEDTWIN_REALTIME;
  void switch_encoder(const Fault& fault, bool on) noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] CommandConditions conditions(int axis) const noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] bool concerns(const Fault& fault, std::size_t axis) const noexcept FEEDTWIN_REALTIME {
    return fault.axis < 0 || static_cast<std::size_t>(fault.axis) == axis;
  }

  std::unique_ptr<Port> owned_;
  Port& inner_;
  double tick_s_;
  std::uint64_t tick_ = 0;  ///< the one that comes next
  std::vector<Timed> faults_;
  std::vector<CommandFault> commands_;
  std::vector<CountFault> counts_;
  std::vector<AxisRequest> requests_;
  std::vector<AxisReport> reports_;
  std::vector<Happening> happenings_;  ///< room for all there can be: each fault begins once and ends once
  std::atomic<std::size_t> happened_{0};
  std::size_t told_ = 0;
};

}  // namespace feedtwin::io::faults
