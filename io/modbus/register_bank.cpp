#include "io/modbus/register_bank.h"

#include <algorithm>
#include <bit>

namespace feedtwin::io::modbus {
namespace {

// TCP loses and reorders nothing, so a sequence that goes back is a controller that has started afresh; the command guard
// knows a new start by a jump that no loss explains.
constexpr std::uint32_t new_start = 0x10000;

bool covers(RegisterRange range, std::size_t address) noexcept {
  return address >= range.begin && address < range.begin + range.count;
}

}  // namespace

RegisterBank::RegisterBank(Exchange& exchange)
    : exchange_(exchange), registers_(mirror_begin + static_cast<std::size_t>(exchange.axes()) * input_stride) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(exchange.axes()); ++axis) {
    // before the first tick: at zero, and not at the -2^31 that registers of zero would mean
    AxisReport nothing_yet;
    nothing_yet.input_age_ns = -1;
    encode({}, nothing_yet, exchange.rated_torque_Nm(axis),
           std::span<std::uint16_t, input_stride>(registers_.data() + mirror_begin + axis * input_stride, input_stride));
  }
}

Extent RegisterBank::extent() const noexcept {
  const auto axes = static_cast<std::size_t>(exchange_.axes());
  return {.commands = axes * holding_stride, .mirror_begin = mirror_begin, .inputs = axes * input_stride};
}

std::span<std::uint16_t, holding_stride> RegisterBank::holding_of(std::size_t axis) noexcept {
  return std::span<std::uint16_t, holding_stride>(registers_.data() + axis * holding_stride, holding_stride);
}

void RegisterBank::refresh(bool somebody_in_command) noexcept {
  if (!exchange_.inputs().take()) return;
  const InputImage& newest = exchange_.inputs().newest();
  std::uint16_t* const inputs = registers_.data() + mirror_begin;
  std::copy_n(newest.begin(), registers_.size() - mirror_begin, inputs);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(exchange_.axes()); ++axis) {
    std::uint16_t& status = inputs[axis * input_stride + input::statusword];
    if (somebody_in_command) status |= status_bit::in_command;
    if (torque_is_clipped(holding_of(axis)[holding::torque])) status |= status_bit::clipped;
  }
}

void RegisterBank::write(const Request& request, std::int64_t arrival_ns) noexcept {
  for (std::size_t i = 0; i < request.write.count; ++i)
    registers_[request.write.begin + i] =
        static_cast<std::uint16_t>(request.written[2 * i] << 8 | request.written[2 * i + 1]);
  const std::size_t first = request.write.begin / holding_stride;
  const std::size_t last = (request.write.begin + request.write.count - 1) / holding_stride;
  for (std::size_t axis = first; axis <= last; ++axis) {
    const auto registers = holding_of(axis);
    const std::size_t base = axis * holding_stride;
    if (covers(request.write, base + holding::torque)) {
      registers[holding::analog_torque] = analog_from_torque(registers[holding::torque]);
    } else if (covers(request.write, base + holding::analog_torque)) {
      registers[holding::torque] = torque_from_analog(registers[holding::analog_torque]);
    }
    if (request.write.begin <= base + holding::analog_torque) put(axis, arrival_ns);  // not for reserved registers alone
  }
  const std::size_t end = request.write.begin + request.write.count;
  if (request.write.begin <= holding::depth_of_cut && end > holding::spindle_speed) {
    exchange_.requests().put(machine_request_from(holding_of(0)));
  }
  exchange_.requests().hand_over();
}

void RegisterBank::put(std::size_t axis, std::int64_t arrival_ns) noexcept {
  const auto registers = holding_of(axis);
  if (torque_is_clipped(registers[holding::torque])) ++clipped_torques_;
  const auto step =
      std::bit_cast<std::int16_t>(static_cast<std::uint16_t>(registers[holding::sequence] - wire_sequence_[axis]));
  sequence_[axis] += static_cast<std::uint32_t>(step) + (step < 0 ? new_start : 0);
  wire_sequence_[axis] = registers[holding::sequence];

  AxisRequest request = request_from(registers, exchange_.rated_torque_Nm(axis));
  request.sequence = sequence_[axis];
  request.counted = registers[holding::sequence] != 0;
  request.arrival_ns = arrival_ns;
  exchange_.requests().put(axis, request);
}

void RegisterBank::forget_commands() noexcept {
  std::fill_n(registers_.begin(), extent().commands, std::uint16_t{0});
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(exchange_.axes()); ++axis) {
    sequence_[axis] = (sequence_[axis] & ~(new_start - 1)) + new_start;
    wire_sequence_[axis] = 0;
  }
}

}  // namespace feedtwin::io::modbus
