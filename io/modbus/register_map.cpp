#include "io/modbus/register_map.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>

namespace feedtwin::io::modbus {
namespace {

constexpr double full_torque = largest_torque;
constexpr double full_analog = 32767.0;

std::uint16_t low(std::uint32_t value) noexcept FEEDTWIN_REALTIME {
  return static_cast<std::uint16_t>(value);
}
std::uint16_t high(std::uint32_t value) noexcept FEEDTWIN_REALTIME {
  return static_cast<std::uint16_t>(value >> 16);
}
std::int16_t signed_of(std::uint16_t value) noexcept {
  return std::bit_cast<std::int16_t>(value);
}

/// To the nearest whole number that fits; not a number gives zero.
template <class Integer>
Integer limited(double value) noexcept FEEDTWIN_REALTIME {
  constexpr double least = std::numeric_limits<Integer>::min(), most = std::numeric_limits<Integer>::max();
  if (!(value == value)) return 0;
  return static_cast<Integer>(std::clamp(value + (value < 0.0 ? -0.5 : 0.5), least, most));
}

}  // namespace

MachineRequest machine_request_from(std::span<const std::uint16_t, holding_stride> registers) noexcept {
  return machine_request(rad_per_s_per_rpm * registers[holding::spindle_speed], registers[holding::auxiliary],
                         1e-6 * registers[holding::depth_of_cut]);
}

bool torque_is_clipped(std::uint16_t torque_register) noexcept {
  return std::abs(int{signed_of(torque_register)}) > largest_torque;
}

std::uint16_t torque_from_analog(std::uint16_t analog_register) noexcept {
  return std::bit_cast<std::uint16_t>(limited<std::int16_t>(signed_of(analog_register) * (full_torque / full_analog)));
}

std::uint16_t analog_from_torque(std::uint16_t torque_register) noexcept {
  return std::bit_cast<std::uint16_t>(limited<std::int16_t>(signed_of(torque_register) * (full_analog / full_torque)));
}

AxisRequest request_from(std::span<const std::uint16_t, holding_stride> registers, double rated_torque_Nm) noexcept {
  const int torque = std::clamp(int{signed_of(registers[holding::torque])}, -largest_torque, largest_torque);
  AxisRequest request;
  request.torque_Nm = torque / full_torque * rated_torque_Nm;
  set_control(request, registers[holding::control]);
  request.watchdog_ns = registers[holding::watchdog] * std::int64_t{1'000'000};
  return request;
}

void encode(const TickReport& tick, const AxisReport& axis, double rated_torque_Nm,
            std::span<std::uint16_t, input_stride> registers) noexcept {
  const auto counts = static_cast<std::uint32_t>(axis.encoder_counts);  // modulo 2^32
  const std::uint32_t offset_counts = counts + 0x8000'0000U;
  const auto velocity_um_per_s = static_cast<std::uint32_t>(limited<std::int32_t>(axis.velocity_m_per_s * 1e6));
  const auto torque = limited<std::int16_t>(axis.torque_Nm / rated_torque_Nm * full_torque);
  const auto ticks = static_cast<std::uint32_t>(tick.tick), missed = static_cast<std::uint32_t>(tick.missed_ticks);

  std::ranges::fill(registers, std::uint16_t{0});
  registers[input::seq_begin] = registers[input::seq_end] = low(ticks);
  registers[input::counts_low] = low(offset_counts);
  registers[input::counts_high] = high(offset_counts);
  registers[input::statusword] = statusword(axis);
  registers[input::velocity] = std::bit_cast<std::uint16_t>(limited<std::int16_t>(axis.velocity_m_per_s * 1e4));
  registers[input::torque] = std::bit_cast<std::uint16_t>(torque);
  registers[input::input_age] = axis.input_age_ns < 0
                                    ? std::uint16_t{65535}
                                    : static_cast<std::uint16_t>(std::min<std::int64_t>(axis.input_age_ns / 1000, 65535));
  registers[input::tick_low] = low(ticks);
  registers[input::tick_high] = high(ticks);
  registers[input::missed_low] = low(missed);
  registers[input::missed_high] = high(missed);
  registers[input::counts_high_first] = registers[input::counts_low_first + 1] = high(counts);
  registers[input::counts_high_first + 1] = registers[input::counts_low_first] = low(counts);
  registers[input::velocity_high_first] = registers[input::velocity_low_first + 1] = high(velocity_um_per_s);
  registers[input::velocity_high_first + 1] = registers[input::velocity_low_first] = low(velocity_um_per_s);
  registers[input::sequence] = low(axis.sequence);
  registers[input::analog_torque] =
      std::bit_cast<std::uint16_t>(limited<std::int16_t>(torque * (full_analog / full_torque)));
}

}  // namespace feedtwin::io::modbus
