#pragma once
// Motor encoder: table travel to quadrature counts, and its index.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace feedtwin::plant {

/// Incremental encoder on the motor shaft; four counts a line.
class Encoder {
 public:
  /// @param lead_m p_b > 0; @param counts_per_rev whole and > 0
  Encoder(double lead_m, double counts_per_rev) noexcept
      : counts_per_m_(counts_per_rev / lead_m), counts_per_rev_(static_cast<std::int64_t>(counts_per_rev)) {}

  /// The count that the encoder shows at a table position; the index is at count 0 of every revolution. It stops at the
  /// farthest count, two of which still have a difference: an axis whose effects feed each other may run away. Wait-free.
  [[nodiscard]] std::int64_t counts(double position_m) const noexcept {
    constexpr double farthest = 4e18;
    return static_cast<std::int64_t>(std::clamp(std::floor(position_m * counts_per_m_ + 0.5), -farthest, farthest));
  }
  [[nodiscard]] double position_m(std::int64_t counts) const noexcept { return static_cast<double>(counts) / counts_per_m_; }
  [[nodiscard]] double resolution_m() const noexcept { return 1.0 / counts_per_m_; }
  [[nodiscard]] std::int64_t counts_per_rev() const noexcept { return counts_per_rev_; }

  /// True if the index lay on the way from one count to the next (the starting count excluded). Wait-free.
  [[nodiscard]] bool index_between(std::int64_t from, std::int64_t to) const noexcept {
    if (from == to) return false;
    return to > from ? revolution(to) != revolution(from) : revolution(from - 1) != revolution(to - 1);
  }

 private:
  [[nodiscard]] std::int64_t revolution(std::int64_t counts) const noexcept {
    const std::int64_t quotient = counts / counts_per_rev_;
    return counts % counts_per_rev_ < 0 ? quotient - 1 : quotient;
  }

  double counts_per_m_;
  std::int64_t counts_per_rev_;
};

}  // namespace feedtwin::plant
