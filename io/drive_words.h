#pragma once
// The control bits and the statusword that the Modbus and UDP ports share.

#include <cstdint>

#include "io/port.h"
#include "plant/realtime.h"

namespace feedtwin::io {

namespace control_bit {
inline constexpr std::uint16_t enable = 1U << 0, quick_stop = 1U << 1, fault_reset = 1U << 7;
}
/// Beside the state's code.
namespace status_bit {
inline constexpr std::uint16_t in_command = 1U << 9, clipped = 1U << 11, index = 1U << 12, low_stop = 1U << 14,
                               high_stop = 1U << 15;
}

inline void set_control(AxisRequest& request, std::uint16_t control) noexcept FEEDTWIN_REALTIME {
  request.enable = (control & control_bit::enable) != 0;
  request.quick_stop = (control & control_bit::quick_stop) != 0;
  request.fault_reset = (control & control_bit::fault_reset) != 0;
}

/// A machine tool's auxiliary functions. The spindle stands where neither of its bits is set, or both.
namespace machine_bit {
inline constexpr unsigned clockwise = 1U << 0, counterclockwise = 1U << 1;  ///< M3, M4
inline constexpr unsigned mist = 1U << 2, flood = 1U << 3;                  ///< M7, M8
}  // namespace machine_bit

[[nodiscard]] inline MachineRequest machine_request(double speed_rad_per_s, unsigned bits,
                                                    double depth_of_cut_m) noexcept FEEDTWIN_REALTIME {
  const unsigned turn = bits & (machine_bit::clockwise | machine_bit::counterclockwise);
  MachineRequest request;
  request.spindle_speed_rad_per_s = turn == machine_bit::clockwise          ? speed_rad_per_s
                                    : turn == machine_bit::counterclockwise ? -speed_rad_per_s
                                                                            : 0.0;
  request.pump = (bits & (machine_bit::mist | machine_bit::flood)) != 0;
  request.depth_of_cut_m = depth_of_cut_m;
  return request;
}
inline constexpr double rad_per_s_per_rpm = 0.10471975511965977;

/// As in CiA 402, bits 0-3, 5, 6.
[[nodiscard]] inline std::uint16_t state_code(DriveState state) noexcept FEEDTWIN_REALTIME {
  switch (state) {
    case DriveState::disabled:
      return 0x0040;
    case DriveState::enabled:
      return 0x0027;
    case DriveState::quick_stop:
      return 0x0007;
    case DriveState::fault:
      break;
  }
  return 0x0008;
}

[[nodiscard]] inline std::uint16_t statusword(const AxisReport& axis) noexcept FEEDTWIN_REALTIME {
  return static_cast<std::uint16_t>(state_code(axis.state) | (axis.index_passed ? status_bit::index : 0) |
                                    (axis.at_low_stop ? status_bit::low_stop : 0) |
                                    (axis.at_high_stop ? status_bit::high_stop : 0));
}

}  // namespace feedtwin::io
