#include "io/registry.h"

#include <array>

#include "io/modbus/modbus_port.h"

namespace feedtwin::io {

std::span<const PortKind> port_kinds() noexcept {
  static constexpr std::array kinds{
      PortKind{"modbus", "Modbus TCP, registers as in io/modbus/register_map.h", modbus::make_modbus_port},
  };
  return kinds;
}

}  // namespace feedtwin::io
