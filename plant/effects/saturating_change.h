#pragma once
// A factor that moves from 1 towards 1 + c as something adds up (time, work):  1 + c (1 - exp(-q / s)).

#include <algorithm>
#include <cmath>

namespace feedtwin::plant {

class SaturatingChange {
 public:
  /// @param change c; @param scale s > 0, in the unit of q
  SaturatingChange(double change, double scale) noexcept : change_(change), scale_(scale) {}

  /// @param q so far; below 0 counts as 0. Wait-free.
  [[nodiscard]] double factor(double q) const noexcept {
    return 1.0 + change_ * (1.0 - std::exp(-std::max(0.0, q) / scale_));
  }

 private:
  double change_, scale_;
};

}  // namespace feedtwin::plant
