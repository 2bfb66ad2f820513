#include "io/modbus/exchange.h"

#include <algorithm>

namespace feedtwin::io::modbus {

Exchange::Exchange(const PortContext& context) : axes_(std::clamp(context.axes, 1, max_axes)) {
  rated_torque_Nm_.fill(PortContext::Axis{}.rated_torque_Nm);
  for (std::size_t axis = 0; axis < std::min(context.axis.size(), rated_torque_Nm_.size()); ++axis)
    rated_torque_Nm_[axis] = context.axis[axis].rated_torque_Nm;
}

void Exchange::send(const TickReport& tick, std::span<const AxisReport> axes) noexcept {
  InputImage& image = inputs_.draft();
  for (std::size_t axis = 0; axis < std::min(axes.size(), static_cast<std::size_t>(axes_)); ++axis)
    encode(tick, axes[axis], rated_torque_Nm_[axis],
           std::span<std::uint16_t, input_stride>(image.data() + axis * input_stride, input_stride));
  inputs_.post();
  requests_.sent();
}

}  // namespace feedtwin::io::modbus
