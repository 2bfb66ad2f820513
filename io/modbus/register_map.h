#pragma once
// The Modbus register map: what each register means, in both directions. Pure: numbers in, numbers out.
//
// Addresses are 0-based as on the wire; in the classic 1-based notation holding 0 is 40001 and input 0 is 30001. Values that
// can be negative are two's complement. Axis n's registers begin at 16 n (holding) and 32 n (input).
//
//   holding  classic  meaning                                                   unit
//   0        40001    torque command, -10000..10000 (beyond: clipped, counted)  0.01 % of rated torque
//   1        40002    control bits: 0 enable, 1 quick stop (the drive brakes by rated torque to rest), 7 fault reset (acts
//                     on its rising edge)
//   2        40003    command sequence, counted up by the controller; 0 if it does not count
//   3        40004    watchdog time; 0: as configured                           ms
//   4        40005    torque command as an analog drive has it: writing it sets register 0   32767 = 10 V = rated torque
//   8        40009    first axis of a machine tool: spindle speed               rpm
//   9        40010    likewise: auxiliary functions, bits 0 M3, 1 M4, 2 M7, 3 M8
//   10       40011    likewise: depth of cut of a slot, where the tool is over the block   um
//   5..15 else        reserved, read as written
//   2000+k   42001+k  what input register k reads: for function 23, which by the standard reads holding registers
//
//   input    classic  meaning                                                   unit
//   0        30001    seq_begin: changes with every tick
//   1, 2     30002    low, high word of (counts + 2^31): low + 65536 high - 2^31 is the signed position
//   3        30004    seq_end, equal to seq_begin unless the reader tore the block apart by reading it in pieces
//   4        30005    statusword, see below
//   5        30006    velocity of the table, i16, limited                       0.1 mm/s
//   6        30007    actual torque, i16, limited                               0.01 % of rated torque
//   7        30008    input age, limited to 65535 (also: no command yet)        us
//   8, 9     30009    tick, low and high word
//   10, 11   30011    missed ticks, low and high word
//   12, 13   30013    counts, int32, high word first
//   14, 15   30015    counts, int32, low word first
//   16, 17   30017    velocity, int32, high word first                          um/s
//   18, 19   30019    velocity, int32, low word first                           um/s
//   20       30021    sequence of the command in force
//   21       30022    actual torque as an analog drive has it                   32767 = 10 V = rated torque
//   22..31            0
//
// Statusword: bits 0-3, 5, 6 as in CiA 402 (mask 6F: 27 operation enabled, 07 quick stop, 08 fault; mask 4F: 40 switch-on
// disabled), and 9 a client is in command, 11 the torque command was clipped, 12 the index was passed within the tick,
// 14 at the low end stop, 15 at the high end stop.

// Writing: the first client to write takes command and keeps it until it disconnects, or until it has written nothing for
// the idle time and another one wants to; the others are answered with exception 6 (busy) and nothing changes. A change of
// command clears the holding registers. Torque commands may come in any order of writes: each write that touches an axis's
// registers 0-4 is a new command made of all five as they then stand.

#include <cstddef>
#include <cstdint>
#include <span>

#include "io/drive_words.h"
#include "io/port.h"
#include "plant/realtime.h"

namespace feedtwin::io::modbus {

inline constexpr int holding_stride = 16;
inline constexpr int input_stride = 32;
inline constexpr int mirror_begin = 2000;  ///< holding address of the copy of input register 0

namespace holding {
enum : std::size_t {
  torque,
  control,
  sequence,
  watchdog,
  analog_torque,
  spindle_speed = 8,
  auxiliary = 9,
  depth_of_cut = 10,
};
}
namespace input {
enum : std::size_t {
  seq_begin = 0,
  counts_low,
  counts_high,
  seq_end,
  statusword,
  velocity,
  torque,
  input_age,
  tick_low,
  tick_high,
  missed_low,
  missed_high,
  counts_high_first = 12,
  counts_low_first = 14,
  velocity_high_first = 16,
  velocity_low_first = 18,
  sequence = 20,
  analog_torque = 21,
};
}
inline constexpr int largest_torque = 10000;  ///< rated torque, in 0.01 %

/// An axis's request from its first holding registers. `sequence` and `arrival_ns` are left to the caller, who knows them.
[[nodiscard]] AxisRequest request_from(std::span<const std::uint16_t, holding_stride> registers,
                                       double rated_torque_Nm) noexcept;
/// A machine's request from the first axis' holding registers.
[[nodiscard]] MachineRequest machine_request_from(std::span<const std::uint16_t, holding_stride> registers) noexcept;
[[nodiscard]] bool torque_is_clipped(std::uint16_t torque_register) noexcept;
/// Analog scale to holding register 0, to the nearest.
[[nodiscard]] std::uint16_t torque_from_analog(std::uint16_t analog_register) noexcept;
[[nodiscard]] std::uint16_t analog_from_torque(std::uint16_t torque_register) noexcept;

/// One axis's input registers, all but the statusword's bits 9 and 11. Wait-free.
void encode(const TickReport& tick, const AxisReport& axis, double rated_torque_Nm,
            std::span<std::uint16_t, input_stride> registers) noexcept FEEDTWIN_REALTIME;

}  // namespace feedtwin::io::modbus
