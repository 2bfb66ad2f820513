#include "io/modbus/exchange.h"

#include <algorithm>

namespace feedtwin::io::modbus {

Exchange::Exchange(const PortContext& context) : axes_(std::clamp(context.axes, 1, max_axes)) {
  rated_torque_Nm_.fill(PortContext::Axis{}.rated_torque_Nm);
  for (std::size_t axis = 0; axis < std::min(context.axis.size(), rated_torque_Nm_.size()); ++axis)
    rated_torque_Nm_[axis] = context.axis[axis].rated_torque_Nm;
}

std::uint64_t Exchange::receive(std::span<AxisRequest> newest) noexcept {
  asked_.store(true, std::memory_order_relaxed);
  if (!requests_.take()) return 0;
  const RequestImage& image = requests_.newest();
  std::uint64_t fresh = 0;
  for (std::size_t axis = 0; axis < std::min(newest.size(), static_cast<std::size_t>(axes_)); ++axis) {
    if (image.number[axis] == number_seen_[axis]) continue;
    newest[axis] = image.request[axis];
    newest[axis].superseded = static_cast<std::uint32_t>(image.number[axis] - number_seen_[axis] - 1);
    superseded_ += newest[axis].superseded;
    number_seen_[axis] = image.number[axis];
    fresh |= std::uint64_t{1} << axis;
  }
  return fresh;
}

bool Exchange::receive_machine(MachineRequest& newest) noexcept {
  const RequestImage& image = requests_.newest();
  if (image.machine_number == machine_number_seen_) return false;
  machine_number_seen_ = image.machine_number;
  newest = image.machine;
  return true;
}

void Exchange::send(const TickReport& tick, std::span<const AxisReport> axes) noexcept {
  InputImage& image = inputs_.draft();
  for (std::size_t axis = 0; axis < std::min(axes.size(), static_cast<std::size_t>(axes_)); ++axis)
    encode(tick, axes[axis], rated_torque_Nm_[axis],
           std::span<std::uint16_t, input_stride>(image.data() + axis * input_stride, input_stride));
  inputs_.post();
  sends_.store(sends_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

}  // namespace feedtwin::io::modbus
