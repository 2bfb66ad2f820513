#pragma once
// What a counter would show of an encoder with broken lines, for ports that carry counts and have no lines.

#include <cstdint>

#include "io/gpio/line_faults.h"
#include "io/port.h"
#include "plant/realtime.h"

namespace feedtwin::io::faults {

class CountFault {
 public:
  void set(EncoderFault fault, bool on, std::int64_t amount) noexcept FEEDTWIN_REALTIME { lines_.set(fault, on, amount); }

  /// The report as the broken encoder gives it. Wait-free.
  void apply(AxisReport& axis) noexcept FEEDTWIN_REALTIME {
    const std::int64_t moved = any_ ? axis.encoder_counts - last_ : axis.encoder_counts;
    any_ = true;
    last_ = axis.encoder_counts;
    if (lines_.dead_a || lines_.dead_b) {
      // the line that lives still turns over: the counter goes one up and down, and never further
      dead_phase_ += moved;
      wobble_ = (dead_phase_ >> 1 & 1) != 0 ? 1 : 0;
      axis.velocity_m_per_s = 0.0;
    } else {
      shown_ += wobble_ + (lines_.swapped_ab ? -moved : moved);
      wobble_ = dead_phase_ = 0;
      if (lines_.swapped_ab) axis.velocity_m_per_s = -axis.velocity_m_per_s;
    }
    axis.encoder_counts = shown_ + wobble_ - lines_.lost_counts;
    if (lines_.missing_index || lines_.dead_index) axis.index_passed = false;
  }

 private:
  gpio::LineFaults lines_;
  bool any_ = false;
  std::int64_t last_ = 0, shown_ = 0, wobble_ = 0, dead_phase_ = 0;
};

}  // namespace feedtwin::io::faults
