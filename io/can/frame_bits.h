#pragma once
// What a frame costs on the wire: ISO 11898-1, base format.

#include "io/can/frame.h"

namespace feedtwin::io::can {

/// Bits from start of frame to the end of the intermission (3 bits), stuff bits included, for this very content.
[[nodiscard]] int bits_on_the_wire(const Frame& frame) noexcept;

/// The most that a data frame of n bytes can take: 47 + 8 n bits and floor((34 + 8 n - 1) / 4) stuff bits
/// (Davis, Burns, Bril, Lukkien 2007, eq. 1); 55 + 10 n.
[[nodiscard]] constexpr int most_bits_on_the_wire(int bytes) noexcept {
  return 47 + 8 * bytes + (34 + 8 * bytes - 1) / 4;
}

}  // namespace feedtwin::io::can
