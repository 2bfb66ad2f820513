#include "io/registry.h"

#include <array>

#include "io/can/can_port.h"
#include "io/gpio/gpio_port.h"
#include "io/modbus/modbus_port.h"
#include "io/udp/udp_port.h"

namespace feedtwin::io {

std::span<const PortKind> port_kinds() noexcept {
  static constexpr std::array kinds{
      PortKind{"can", "SocketCAN: CANopen drives (CiA 402, cyclic synchronous torque) or ODrive CAN Simple",
               can::make_can_port},
      PortKind{"gpio", "quadrature encoder lines A, B, Z on a GPIO chip", gpio::make_gpio_port},
      PortKind{"modbus", "Modbus TCP, registers as in io/modbus/register_map.h", modbus::make_modbus_port},
      PortKind{"udp", "UDP, datagrams as in io/udp/datagram.h", udp::make_udp_port},
  };
  return kinds;
}

}  // namespace feedtwin::io
