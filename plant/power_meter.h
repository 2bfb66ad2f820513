#pragma once
// Power meter of the source's testbed (section 3.1): 10 readings a second, each the mean of its window, shown from the
// window's end on. It reads 0 before the first. Other meters average for longer than from one reading to the next.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace feedtwin::plant {

class PowerMeter {
 public:
  /// @param every_s between readings: of windows that overlap, up to 64 at a time; 0: one window after the other
  explicit PowerMeter(double window_s = 0.1, double every_s = 0.0) noexcept
      : every_s_(every_s > 0.0 ? every_s : window_s),
        parts_(std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(window_s / every_s_)), 1, most_parts)) {}

  /// Mean power over one tick; returns what the meter shows at the tick's end. Wait-free.
  double update(double power_W, double tick_s) noexcept {
    energy_J_ += power_W * tick_s;
    elapsed_s_ += tick_s;
    if (elapsed_s_ >= every_s_ - 0.5 * tick_s) {
      passed_[next_] = {energy_J_, elapsed_s_};
      next_ = (next_ + 1) % parts_;
      energy_J_ = elapsed_s_ = 0.0;
      double all_J = 0.0, all_s = 0.0;  // of what has passed by now
      for (std::size_t i = 0; i < parts_; ++i) all_J += passed_[i].energy_J, all_s += passed_[i].span_s;
      shown_W_ = all_J / all_s;
    }
    return shown_W_;
  }
  [[nodiscard]] double shown_W() const noexcept { return shown_W_; }

 private:
  static constexpr std::size_t most_parts = 64;
  struct Part {
    double energy_J = 0.0, span_s = 0.0;
  };
  double every_s_;
  std::size_t parts_, next_ = 0;
  std::array<Part, most_parts> passed_{};
  double energy_J_ = 0.0;
  double elapsed_s_ = 0.0;
  double shown_W_ = 0.0;
};

}  // namespace feedtwin::plant
