#pragma once
// A port without a wire: a scripted controller in this process at the end of two lines with faults. For tests of whatever
// stands on the port interface; time is counted in ticks, so that every run of a seed is the same.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "io/port.h"
#include "io/registry.h"
#include "io/tally.h"
#include "io/twin/line.h"

namespace feedtwin::io::twin {

/// What the controller does with a report that has reached it: fill in the requests and return true, or stay silent.
using Controller =
    std::function<bool(const TickReport& tick, std::span<const AxisReport> axes, std::span<AxisRequest> requests)>;

struct TwinSettings {
  LineFaults to_controller, to_plant;
  std::uint64_t seed = 1;
  std::size_t capacity = 256;  ///< messages under way on each line
};

class TwinPort final : public Port {
 public:
  TwinPort(Controller controller, const TwinSettings& settings, const PortContext& context);

  [[nodiscard]] std::string_view name() const noexcept override { return "twin"; }
  void open() override {}
  void close() noexcept override {}
  /// Everything that has arrived since the last tick, in the order of arrival; the last one is what the loop gets.
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME override;
  /// Reports on their way; the controller is called here with those that arrive.
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME override;
  [[nodiscard]] std::vector<Counter> counters() const override;

 private:
  struct Report {
    TickReport tick;
    std::vector<AxisReport> axes;
  };
  using Requests = std::vector<AxisRequest>;

  void deliver();

  Controller controller_;
  Line<Report> reports_;
  Line<Requests> requests_;
  Report report_;
  Requests answer_;
  std::uint64_t now_tick_ = 0;
  std::int64_t now_ns_ = 0;
  Tally arrived_;
};

}  // namespace feedtwin::io::twin
