#include "tools/loopback/loopback_port.h"

#include <algorithm>

namespace feedtwin::tools {

LoopbackPort::LoopbackPort(const std::vector<LoopbackSettings>& settings, const io::PortContext& context)
    : requests_(settings.size()), tick_s_(context.tick_s) {
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const auto& about = context.axis[i];
    axes_.push_back({settings[i].motion->make(settings[i].motion_settings), controllers::Cascade(settings[i].gains),
                     about.lead_m / about.encoder_counts_per_rev});
    axes_.back().controller.reset(axes_.back().motion->at(0.0).position_m);
  }
}

double LoopbackPort::reference_m(std::size_t axis, std::uint64_t tick) const noexcept {
  return axes_[axis].motion->at(static_cast<double>(tick) * tick_s_).position_m;
}

void LoopbackPort::send(const io::TickReport& tick, std::span<const io::AxisReport> reports) noexcept {
  const double time_s = static_cast<double>(next_tick_) * tick_s_;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Axis& axis = axes_[i];
    const double position_m = static_cast<double>(reports[i].encoder_counts) * axis.m_per_count;
    io::AxisRequest& request = requests_[i];
    request.torque_Nm = axis.controller.torque_Nm(axis.motion->at(time_s), position_m, tick_s_);
    request.sequence = static_cast<std::uint32_t>(next_tick_);
    request.arrival_ns = tick.start_ns;
    // a controller that came back after a stall clears the watchdog's fault by giving the enable anew
    request.enable = reports[i].state != io::DriveState::fault;
  }
  ++next_tick_;
  pending_ = true;
}

std::uint64_t LoopbackPort::receive(std::span<io::AxisRequest> newest) noexcept {
  if (!pending_) return 0;
  pending_ = false;
  std::ranges::copy(requests_, newest.begin());
  return axes_.size() >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << axes_.size()) - 1;
}

}  // namespace feedtwin::tools
