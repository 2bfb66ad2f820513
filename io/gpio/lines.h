#pragma once
// Output lines that are set together: a GPIO chip (libgpiod_lines.h), or a twin that remembers.

#include <cstdint>
#include <span>
#include <string>

#include "plant/realtime.h"

namespace feedtwin::io::gpio {

/// Lines in one bulk set, at most: the kernel's limit.
inline constexpr int most_lines = 64;

class Lines {
 public:
  Lines() = default;
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;
  virtual ~Lines() = default;

  /// Set-up; throws PortError. @param levels one a line, low or high
  virtual void open(std::uint64_t levels) = 0;
  virtual void close() noexcept = 0;
  /// Set all lines at once, bit 0 the first. @return false if the kernel refused.
  virtual bool set(std::uint64_t levels) noexcept = 0;
};

}  // namespace feedtwin::io::gpio
