#pragma once
// Between the tick and the Modbus server's thread: requests one way, input registers the other, both wait-free.

#include <array>
#include <cstdint>
#include <span>

#include "io/mailbox.h"
#include "io/modbus/register_map.h"
#include "io/port.h"
#include "io/registry.h"
#include "io/request_exchange.h"

namespace feedtwin::io::modbus {

using InputImage = std::array<std::uint16_t, std::size_t{max_axes} * input_stride>;

class Exchange {
 public:
  explicit Exchange(const PortContext& context);

  [[nodiscard]] int axes() const noexcept { return axes_; }
  [[nodiscard]] double rated_torque_Nm(std::size_t axis) const noexcept { return rated_torque_Nm_[axis]; }

  /// The tick's side.
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME;
  /// The server's side.
  Mailbox<InputImage>& inputs() noexcept { return inputs_; }
  RequestExchange& requests() noexcept { return requests_; }
  [[nodiscard]] const RequestExchange& requests() const noexcept { return requests_; }

 private:
  int axes_;
  std::array<double, max_axes> rated_torque_Nm_{};
  RequestExchange requests_;
  Mailbox<InputImage> inputs_;
};

}  // namespace feedtwin::io::modbus
