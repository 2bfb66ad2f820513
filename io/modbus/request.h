#pragma once
// A Modbus TCP request: where it ends in the stream, and whether it may be answered. Pure: bytes in, a verdict out.
//
// After "MODBUS Messaging on TCP/IP Implementation Guide" V1.0b and "MODBUS Application Protocol" V1.1b3. Frames are cut by
// the header's own length; libmodbus 3.1.6 goes by the function code and so loses its place at the first function that it
// does not know. All checks are made here because modbus_reply() answers a wrong number of registers by sleeping for its
// response time-out and then throwing away what the client has sent since.

#include <cstddef>
#include <cstdint>
#include <span>

namespace feedtwin::io::modbus {

inline constexpr std::size_t header_bytes = 7;  ///< transaction, protocol, length, unit
inline constexpr std::size_t largest_frame_bytes = 260;

enum class Function : std::uint8_t {
  read_holding = 3,
  read_input = 4,
  write_one = 6,
  write_many = 16,
  write_and_read = 23,
};

/// What is answered instead of data.
enum class Refusal : std::uint8_t {
  none = 0,
  illegal_function = 1,
  illegal_address = 2,
  illegal_value = 3,
  busy = 6,  ///< another client, or another port, is in command
};

struct RegisterRange {
  std::size_t begin = 0, count = 0;
  [[nodiscard]] bool within(RegisterRange outer) const noexcept {
    return begin >= outer.begin && begin + count <= outer.begin + outer.count;
  }
};

/// How much of the stream's beginning is one frame.
struct Cut {
  std::size_t bytes = 0;   ///< 0: not all there yet
  bool malformed = false;  ///< no Modbus, or no longer: the connection is of no more use
};
[[nodiscard]] Cut cut_frame(std::span<const std::uint8_t> stream) noexcept;

struct Request {
  Refusal refusal = Refusal::none;
  Function function{};        // NOLINT(bugprone-invalid-enum-default-initialization): of no meaning where refused
  RegisterRange read, write;  ///< in input registers for read_input, holding registers otherwise
  std::span<const std::uint8_t> written;  ///< two bytes a register, high byte first
};

/// What the server has: holding registers that may be written, their mirror of the input registers, input registers.
struct Extent {
  std::size_t commands = 0, mirror_begin = 0, inputs = 0;
};
/// @param frame whole, as cut_frame() gave it
[[nodiscard]] Request check(std::span<const std::uint8_t> frame, const Extent& extent) noexcept;

}  // namespace feedtwin::io::modbus
