#pragma once
// The plant's own UDP protocol: one datagram of torques in, one of counts out. Pure: bytes in, numbers out, and back.
//
// All numbers little-endian, no padding beyond what is named. A request is answered with one reply, at the end of the tick
// in which it acts; several that come within one tick: the newest acts and is answered (free-running), or each one makes a
// tick of its own (lockstep). A request seen before is not used again; in lockstep its reply is sent again.
//
//   request: 24 + 16 n bytes                             reply: 48 + 32 n bytes
//    0  u8[4] magic "FTWN"                                0  u8[4] magic "FTWN"
//    4  u8    version, 1                                  4  u8    version, 1
//    5  u8    kind, 1                                     5  u8    kind, 2
//    6  u8    n, number of axes, from 1                   6  u8    n, number of the plant's axes
//    7  u8    auxiliary bits (M3, M4, M7, M8)             7  u8    0
//    8  u32   sequence, counted up by the controller      8  u32   sequence of the request answered
//   12  f32   spindle speed, rad/s                       12  u32   0
//   16  u64   stamp, the controller's own                16  u64   stamp of the request answered
//   then for each axis:                                  24  u64   tick
//    0  f64   torque, N m                                32  u64   missed ticks
//    8  u16   control bits, as Modbus holding 1          40  i64   input age: from the request's arrival to its use, ns
//   10  u16   watchdog, ms; 0: as configured             then for each axis:
//   12  f32   first axis: depth of cut, m; else 0         0  i64   counts
//                                                         8  f64   velocity of the table, m/s
//                                                        16  f64   actual torque, N m
//                                                        24  u16   statusword, as Modbus input 4
//                                                        26  u8[6] 0
//
// Spindle, auxiliary bits (io/drive_words.h) and depth of cut are a machine tool's; an axis by itself leaves them at 0.
// Up to 44 axes a reply fits into one Ethernet frame.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/port.h"
#include "plant/realtime.h"

namespace feedtwin::io::udp {

inline constexpr std::size_t request_header_bytes = 24, request_axis_bytes = 16;
inline constexpr std::size_t reply_header_bytes = 48, reply_axis_bytes = 32;
inline constexpr std::size_t largest_request_bytes = request_header_bytes + request_axis_bytes * max_axes;
inline constexpr std::size_t largest_reply_bytes = reply_header_bytes + reply_axis_bytes * max_axes;

struct Request {
  std::uint32_t sequence = 0;
  std::uint64_t stamp = 0;
  std::size_t axes = 0;
  std::array<AxisRequest, max_axes> axis{};  ///< without sequence and arrival
  MachineRequest machine{};
};

/// @return false if this is no request for a plant of so many axes. Wait-free.
[[nodiscard]] bool decode(std::span<const std::uint8_t> bytes, std::size_t plant_axes,
                          Request& request) noexcept FEEDTWIN_REALTIME;

struct Reply {
  std::uint32_t sequence = 0;
  std::uint64_t stamp = 0;
  TickReport tick;
};

/// @return the number of bytes. Wait-free.
std::size_t encode(const Reply& reply, std::span<const AxisReport> axes,
                   std::span<std::uint8_t, largest_reply_bytes> bytes) noexcept FEEDTWIN_REALTIME;

}  // namespace feedtwin::io::udp
