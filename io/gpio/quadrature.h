#pragma once
// An incremental encoder's lines: counts to levels of A, B and Z, edges spread over a tick, and back.
//
// Four counts a line; positive motion: A leads B (AB 00, 10, 11, 01); Z is high in the one state at count 0 of a revolution.

#include <algorithm>
#include <cstdint>

#include "plant/realtime.h"

namespace feedtwin::io::gpio {

/// Bits of a line state.
enum Line : std::uint8_t { line_a = 1, line_b = 2, line_z = 4 };

/// The levels at a count. Wait-free.
[[nodiscard]] constexpr std::uint8_t levels_at(std::int64_t count, std::int64_t counts_per_rev) noexcept FEEDTWIN_REALTIME {
  constexpr std::uint8_t states[4] = {0, line_a, line_a | line_b, line_b};
  const auto state = states[static_cast<std::uint64_t>(count) & 3U];
  return count % counts_per_rev == 0 ? static_cast<std::uint8_t>(state | line_z) : state;
}

/// When the edges of one axis fall due: from where the lines are to where the plant says, evenly over a tick, never closer
/// together than the minimum spacing. What does not fit into the tick is made up for in the next ones, and counted.
class EdgeSchedule {
 public:
  EdgeSchedule(std::int64_t start_count, std::int64_t tick_ns, std::int64_t spacing_ns) noexcept
      : count_(start_count), target_(start_count), tick_ns_(tick_ns), spacing_ns_(spacing_ns) {}

  /// The plant was at `target` at the end of the tick that began at start_ns; the lines follow one tick later. Wait-free.
  void aim(std::int64_t target, std::int64_t start_ns) noexcept FEEDTWIN_REALTIME {
    target_ = target;
    const std::int64_t edges = left();
    const std::int64_t fitting = tick_ns_ / spacing_ns_;
    if (edges > fitting + 1) {  // one more is the rounding to whole counts at the stated rate
      ++overspeed_ticks_;
      most_behind_ = std::max(most_behind_, edges - fitting);
    }
    if (edges == 0) return;
    step_ns_ = std::max(tick_ns_ / edges, spacing_ns_);
    // in the middle of its share of the tick, but not closer to the last edge than is allowed
    due_ns_ = std::max(start_ns + std::min(step_ns_, tick_ns_) / 2, last_ns_ + spacing_ns_);
  }
  /// Stand at a count without edges on the way there. Wait-free.
  void place(std::int64_t count) noexcept FEEDTWIN_REALTIME { count_ = target_ = count; }
  [[nodiscard]] bool idle() const noexcept FEEDTWIN_REALTIME { return count_ == target_; }
  [[nodiscard]] std::int64_t due_ns() const noexcept FEEDTWIN_REALTIME { return due_ns_; }
  /// The edge was put out at now_ns. Lateness is kept as it is: the spacing stays, edges never come in a burst. Wait-free.
  void done(std::int64_t now_ns) noexcept FEEDTWIN_REALTIME {
    count_ += target_ > count_ ? 1 : -1;
    ++edges_;
    last_ns_ = now_ns;
    due_ns_ = std::max(due_ns_ + step_ns_, now_ns + spacing_ns_);
  }

  [[nodiscard]] std::int64_t count() const noexcept FEEDTWIN_REALTIME { return count_; }
  [[nodiscard]] std::int64_t left() const noexcept FEEDTWIN_REALTIME {
    return target_ > count_ ? target_ - count_ : count_ - target_;
  }
  [[nodiscard]] std::uint64_t edges() const noexcept { return edges_; }
  /// Ticks that asked for more edges than fit, and by how many at worst.
  [[nodiscard]] std::uint64_t overspeed_ticks() const noexcept { return overspeed_ticks_; }
  [[nodiscard]] std::int64_t most_behind() const noexcept { return most_behind_; }

 private:
  std::int64_t count_, target_;
  std::int64_t tick_ns_, spacing_ns_;
  std::int64_t due_ns_ = 0, step_ns_ = 0, last_ns_ = 0;
  std::uint64_t edges_ = 0, overspeed_ticks_ = 0;
  std::int64_t most_behind_ = 0;
};

/// Reads the lines back: what a counter card would make of them.
class QuadratureDecoder {
 public:
  /// @param levels to begin with
  explicit QuadratureDecoder(std::uint8_t levels) noexcept : levels_(levels) {}

  void see(std::uint8_t levels) noexcept {
    const int from = position(levels_), to = position(levels);
    switch ((to - from) & 3) {
      case 1:
        ++count_;
        break;
      case 3:
        --count_;
        break;
      case 2:
        ++illegal_;  // both lines at once: the direction is lost
        break;
      default:
        break;
    }
    if ((levels & line_z) != 0 && (levels_ & line_z) == 0) {
      ++indices_;
      last_index_ = count_;
    }
    levels_ = levels;
  }
  [[nodiscard]] std::int64_t count() const noexcept { return count_; }
  [[nodiscard]] std::uint64_t illegal() const noexcept { return illegal_; }
  [[nodiscard]] std::uint64_t indices() const noexcept { return indices_; }
  [[nodiscard]] std::int64_t count_at_last_index() const noexcept { return last_index_; }

 private:
  /// Place in the cycle AB 00, 10, 11, 01.
  [[nodiscard]] static int position(std::uint8_t levels) noexcept {
    const bool a = (levels & line_a) != 0, b = (levels & line_b) != 0;
    return a ? (b ? 2 : 1) : (b ? 3 : 0);
  }
  std::uint8_t levels_;
  std::int64_t count_ = 0, last_index_ = 0;
  std::uint64_t illegal_ = 0, indices_ = 0;
};

}  // namespace feedtwin::io::gpio
