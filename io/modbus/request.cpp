#include "io/modbus/request.h"

namespace feedtwin::io::modbus {
namespace {

// the standard's limits on the number of registers in one request
constexpr std::size_t most_read = 125, most_written = 123, most_written_while_reading = 121;

std::size_t word(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return static_cast<std::size_t>(bytes[at] << 8 | bytes[at + 1]);
}

RegisterRange range(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return {word(bytes, at), word(bytes, at + 2)};
}

bool number_fits(RegisterRange r, std::size_t most) noexcept {
  return r.count >= 1 && r.count <= most;
}

/// The registers' values at the end of a request, with their number of bytes before them.
bool take_values(std::span<const std::uint8_t> data, std::size_t at, Request& request) noexcept {
  if (data.size() <= at || data[at] != 2 * request.write.count || data.size() != at + 1 + data[at]) return false;
  request.written = data.subspan(at + 1);
  return true;
}

/// `data` follows the function code. @return false where number or length is wrong
bool parse(std::span<const std::uint8_t> data, Request& request) noexcept {
  switch (request.function) {
    case Function::read_holding:
    case Function::read_input:
      if (data.size() != 4) return false;
      request.read = range(data, 0);
      return number_fits(request.read, most_read);
    case Function::write_one:
      if (data.size() != 4) return false;
      request.write = {word(data, 0), 1};
      request.written = data.subspan(2);
      return true;
    case Function::write_many:
      if (data.size() < 5) return false;
      request.write = range(data, 0);
      return number_fits(request.write, most_written) && take_values(data, 4, request);
    case Function::write_and_read:
      if (data.size() < 9) return false;
      request.read = range(data, 0);
      request.write = range(data, 4);
      return number_fits(request.read, most_read) && number_fits(request.write, most_written_while_reading) &&
             take_values(data, 8, request);
  }
  return false;
}

bool known(Function function) noexcept {
  switch (function) {
    case Function::read_holding:
    case Function::read_input:
    case Function::write_one:
    case Function::write_many:
    case Function::write_and_read:
      return true;
  }
  return false;
}

bool addresses_exist(const Request& request, const Extent& extent) noexcept {
  const RegisterRange commands{0, extent.commands}, inputs{0, extent.inputs}, mirror{extent.mirror_begin, extent.inputs};
  if (request.write.count > 0 && !request.write.within(commands)) return false;
  if (request.read.count == 0) return true;
  if (request.function == Function::read_input) return request.read.within(inputs);
  return request.read.within(commands) || request.read.within(mirror);
}

}  // namespace

Cut cut_frame(std::span<const std::uint8_t> stream) noexcept {
  if (stream.size() < 6) return {};
  const std::size_t protocol = word(stream, 2), length = word(stream, 4);  // the length counts from the unit identifier
  if (protocol != 0 || length < 2 || length > largest_frame_bytes - 6) return {.bytes = 0, .malformed = true};
  return {.bytes = stream.size() >= 6 + length ? 6 + length : 0, .malformed = false};
}

Request check(std::span<const std::uint8_t> frame, const Extent& extent) noexcept {
  Request request;
  request.function = static_cast<Function>(frame[header_bytes]);
  if (!known(request.function)) {
    request.refusal = Refusal::illegal_function;
  } else if (!parse(frame.subspan(header_bytes + 1), request)) {
    request.refusal = Refusal::illegal_value;
  } else if (!addresses_exist(request, extent)) {
    request.refusal = Refusal::illegal_address;
  }
  return request;
}

}  // namespace feedtwin::io::modbus
