#pragma once
// Faults on purpose between the encoder and its lines.

#include <cstdint>

#include "io/gpio/quadrature.h"
#include "io/port.h"
#include "plant/realtime.h"

namespace feedtwin::io::gpio {

/// Which faults act on one axis's lines.
struct LineFaults {
  bool dead_a = false, dead_b = false, dead_index = false, swapped_ab = false, missing_index = false;
  std::int64_t lost_counts = 0;  ///< the lines are this many counts behind the encoder

  void set(EncoderFault fault, bool on, std::int64_t amount) noexcept FEEDTWIN_REALTIME {
    switch (fault) {
      case EncoderFault::dead_a:
        dead_a = on;
        return;
      case EncoderFault::dead_b:
        dead_b = on;
        return;
      case EncoderFault::dead_index:
        dead_index = on;
        return;
      case EncoderFault::swapped_ab:
        swapped_ab = on;
        return;
      case EncoderFault::missing_index:
        missing_index = on;
        return;
      case EncoderFault::lost_counts:
        if (on) lost_counts += amount;  // what is lost stays lost
        return;
    }
  }

  /// What comes out on the lines. A dead line stays as `before` had it; a missing index is low. Wait-free.
  [[nodiscard]] std::uint8_t apply(std::uint8_t levels, std::uint8_t before) const noexcept FEEDTWIN_REALTIME {
    if (swapped_ab) {
      levels = static_cast<std::uint8_t>((levels & line_z) | ((levels & line_a) != 0 ? line_b : 0) |
                                         ((levels & line_b) != 0 ? line_a : 0));
    }
    if (missing_index) levels = static_cast<std::uint8_t>(levels & ~line_z);
    const auto dead = static_cast<std::uint8_t>((dead_a ? line_a : 0) | (dead_b ? line_b : 0) | (dead_index ? line_z : 0));
    return static_cast<std::uint8_t>((levels & ~dead) | (before & dead));
  }
};

}  // namespace feedtwin::io::gpio
