#pragma once
// Counts of durations in fixed log-linear buckets (as HdrHistogram): below 2 % error from 1 ns to 17 s, wait-free to
// record, 9 KiB, no allocation.

#include <array>
#include <bit>
#include <cstdint>

#include "plant/realtime.h"

namespace feedtwin::rt {

class LatencyHistogram {
 public:
  /// Negative durations count as 0. Wait-free.
  void record(std::int64_t duration_ns) noexcept FEEDTWIN_REALTIME {
    const std::uint64_t value = duration_ns > 0 ? static_cast<std::uint64_t>(duration_ns) : 0;
    ++counts_[bucket(value)];
    ++total_;
    if (duration_ns > max_ns_) max_ns_ = duration_ns;
  }

  [[nodiscard]] std::uint64_t total() const noexcept { return total_; }
  [[nodiscard]] std::int64_t max_ns() const noexcept { return max_ns_; }

  /// The duration that `share` (0..1) of the records do not exceed, in us; 0 without records.
  [[nodiscard]] double percentile_us(double share) const noexcept;

  /// Calls `visit(upper_edge_us, count)` for every bucket in use, in order.
  template <class Visit>
  void each(Visit visit) const {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] > 0) visit(static_cast<double>(upper_edge(i)) * 1e-3, counts_[i]);
    }
  }

 private:
  static constexpr int sub_bits = 6;  // 64 buckets an octave: 1/64 = 1.6 %
  static constexpr int octaves = 29;
  static constexpr std::size_t buckets = (octaves + 1) << sub_bits;

  [[nodiscard]] static std::size_t bucket(std::uint64_t value) noexcept FEEDTWIN_REALTIME {
    constexpr std::uint64_t linear = 1U << sub_bits;
    if (value < linear) return static_cast<std::size_t>(value);
    const int shift = static_cast<int>(std::bit_width(value)) - 1 - sub_bits;
    const std::size_t index =
        (static_cast<std::size_t>(shift + 1) << sub_bits) + static_cast<std::size_t>((value >> shift) - linear);
    return index < buckets ? index : buckets - 1;
  }
  [[nodiscard]] static std::uint64_t upper_edge(std::size_t index) noexcept;

  std::array<std::uint64_t, buckets> counts_{};
  std::uint64_t total_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace feedtwin::rt
