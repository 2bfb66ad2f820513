#pragma once
// A factor that moves from 1 + b towards 1 + c as something adds up (time, work):  1 + c + (b - c) exp(-q / s).

#include <algorithm>
#include <cmath>

namespace feedtwin::plant {

class SaturatingChange {
 public:
  /// @param change c; @param scale s > 0, in the unit of q; @param before b, what a run begins with
  SaturatingChange(double change, double scale, double before) noexcept : change_(change), scale_(scale), before_(before) {}

  /// @param q so far; below 0 counts as 0. Wait-free.
  [[nodiscard]] double factor(double q) const noexcept {
    return 1.0 + change_ + (before_ - change_) * std::exp(-std::max(0.0, q) / scale_);
  }

 private:
  double change_, scale_, before_;
};

}  // namespace feedtwin::plant
