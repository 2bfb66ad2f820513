#pragma once
// Power meter of the source's testbed (section 3.1): 10 readings a second, each the mean of its window, shown from the
// window's end on. It reads 0 before the first.

#include <cmath>

namespace feedtwin::plant {

class PowerMeter {
 public:
  explicit PowerMeter(double window_s = 0.1) noexcept : window_s_(window_s) {}

  /// Mean power over one tick; returns what the meter shows at the tick's end. Wait-free.
  double update(double power_W, double tick_s) noexcept {
    energy_J_ += power_W * tick_s;
    elapsed_s_ += tick_s;
    if (elapsed_s_ >= window_s_ - 0.5 * tick_s) {
      shown_W_ = energy_J_ / elapsed_s_;
      energy_J_ = 0.0;
      elapsed_s_ = 0.0;
    }
    return shown_W_;
  }
  [[nodiscard]] double shown_W() const noexcept { return shown_W_; }

 private:
  double window_s_;
  double energy_J_ = 0.0;
  double elapsed_s_ = 0.0;
  double shown_W_ = 0.0;
};

}  // namespace feedtwin::plant
