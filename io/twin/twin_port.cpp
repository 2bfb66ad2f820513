#include "io/twin/twin_port.h"

#include <algorithm>

namespace feedtwin::io::twin {
namespace {

std::size_t axes_of(const PortContext& context) {
  return static_cast<std::size_t>(std::clamp(context.axes, 1, max_axes));
}

}  // namespace

TwinPort::TwinPort(Controller controller, const TwinSettings& settings, const PortContext& context)
    : controller_(std::move(controller)),
      reports_(settings.to_controller, settings.seed, settings.capacity, {{}, std::vector<AxisReport>(axes_of(context))}),
      requests_(settings.to_plant, settings.seed + 1, settings.capacity, Requests(axes_of(context))),
      report_{{}, std::vector<AxisReport>(axes_of(context))},
      answer_(axes_of(context)) {}

std::uint64_t TwinPort::receive(std::span<AxisRequest> newest) noexcept {
  std::uint64_t fresh = 0;
  FEEDTWIN_ADMIT_BEGIN  // a test's own line
      while (const Requests* arrived = requests_.receive(now_tick_)) {
    ++arrived_;
    for (std::size_t i = 0; i < std::min(newest.size(), arrived->size()); ++i) {
      const bool replaces = ((fresh >> i) & 1U) != 0;
      newest[i] = replaces ? replacing(newest[i], (*arrived)[i]) : (*arrived)[i];
      newest[i].arrival_ns = now_ns_;
      fresh |= std::uint64_t{1} << i;
    }
  }
  FEEDTWIN_ADMIT_END
  return fresh;
}

void TwinPort::send(const TickReport& tick, std::span<const AxisReport> axes) noexcept {
  FEEDTWIN_ADMIT_BEGIN  // a test's own line and controller
      report_.tick = tick;
  std::copy_n(axes.begin(), std::min(axes.size(), report_.axes.size()), report_.axes.begin());
  ++now_tick_;
  now_ns_ = tick.start_ns;
  reports_.send(report_, now_tick_);
  deliver();
  FEEDTWIN_ADMIT_END
}

void TwinPort::deliver() {
  while (const Report* arrived = reports_.receive(now_tick_)) {
    if (controller_(arrived->tick, arrived->axes, answer_)) requests_.send(answer_, now_tick_);
  }
}

std::vector<Counter> TwinPort::counters() const {
  return {
      {"twin_arrived", "requests that arrived", arrived_.value()},
      {"twin_lost_reports", "reports lost on purpose", reports_.lost()},
      {"twin_lost_requests", "requests lost on purpose", requests_.lost()},
      {"twin_duplicated", "messages sent twice on purpose", reports_.duplicated() + requests_.duplicated()},
  };
}

}  // namespace feedtwin::io::twin
