#pragma once
// The registers as the clients see them, on the server's thread: holding registers that they write, input registers that
// follow the tick, and the requests that go to the tick.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/modbus/exchange.h"
#include "io/modbus/request.h"
#include "io/tally.h"

namespace feedtwin::io::modbus {

class RegisterBank {
 public:
  explicit RegisterBank(Exchange& exchange);

  [[nodiscard]] Extent extent() const noexcept;
  [[nodiscard]] bool writable() const noexcept { return !exchange_.requests().only_watched(); }
  /// Bring the input registers up to the last tick.
  void refresh(bool somebody_in_command) noexcept;
  /// Store what a client wrote, checked before, and give the axes that it touches to the tick.
  void write(const Request& request, std::int64_t arrival_ns) noexcept;
  /// The client in command has changed or gone: his registers are of no meaning to the next one. The plant is not told:
  /// the watchdog takes the torque away, as after any other silence.
  void forget_commands() noexcept;

  /// All registers, from holding register 0; the input registers follow at mirror_begin.
  [[nodiscard]] std::span<std::uint16_t> registers() noexcept { return registers_; }
  [[nodiscard]] const Tally& clipped_torques() const noexcept { return clipped_torques_; }

 private:
  void put(std::size_t axis, std::int64_t arrival_ns) noexcept;
  [[nodiscard]] std::span<std::uint16_t, holding_stride> holding_of(std::size_t axis) noexcept;

  Exchange& exchange_;
  std::vector<std::uint16_t> registers_;
  std::array<std::uint32_t, max_axes> sequence_{};  ///< the 16 bits of the wire, continued to 32
  std::array<std::uint16_t, max_axes> wire_sequence_{};
  Tally clipped_torques_;
};

}  // namespace feedtwin::io::modbus
