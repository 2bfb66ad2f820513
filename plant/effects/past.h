#pragma once
// The last values of a signal, for delays. Fixed size, so that the tick never allocates.

#include <array>
#include <cstddef>

namespace feedtwin::plant {

class Past {
 public:
  static constexpr int longest = 200;  ///< ticks back

  void push(double value) noexcept {
    newest_ = (newest_ + 1) % values_.size();
    values_[newest_] = value;
  }
  /// @param ticks 0 (the newest) to longest
  [[nodiscard]] double ago(int ticks) const noexcept {
    return values_[(newest_ + values_.size() - static_cast<std::size_t>(ticks)) % values_.size()];
  }
  void fill(double value) noexcept { values_.fill(value); }

 private:
  std::array<double, 256> values_{};
  std::size_t newest_ = 0;
};

}  // namespace feedtwin::plant
