#pragma once
// Power meter of the source's testbed (section 3.1): 10 readings a second, each the mean of its window, shown from the
// window's end on. It reads 0 before the first. Other meters average for longer than from one reading to the next, or for
// the last part of that time.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace feedtwin::plant {

class PowerMeter {
 public:
  static constexpr double least_readings = 0.01, most_readings = 64.0;

  /// @param readings that a window spans: one comes every window_s / readings. 1 to 64, whole, or less than one
  explicit PowerMeter(double window_s = 0.1, double readings = 1.0) noexcept
      : parts_(static_cast<std::size_t>(std::clamp(std::round(readings), 1.0, most_readings))),
        every_s_(window_s / (readings < 1.0 ? std::max(readings, least_readings) : static_cast<double>(parts_))),
        idle_s_(readings < 1.0 ? every_s_ - window_s : 0.0) {}

  /// Mean power over one tick; returns what the meter shows at the tick's end. Wait-free.
  double update(double power_W, double tick_s) noexcept {
    elapsed_s_ += tick_s;
    if (elapsed_s_ > idle_s_ + 0.5 * tick_s) energy_J_ += power_W * tick_s, read_s_ += tick_s;
    if (elapsed_s_ >= every_s_ - 0.5 * tick_s) {
      passed_[next_] = {energy_J_, read_s_};
      next_ = (next_ + 1) % parts_;
      energy_J_ = elapsed_s_ = read_s_ = 0.0;
      double all_J = 0.0, all_s = 0.0;  // of what has passed by now
      for (std::size_t i = 0; i < parts_; ++i) all_J += passed_[i].energy_J, all_s += passed_[i].span_s;
      shown_W_ = all_J / all_s;
    }
    return shown_W_;
  }
  [[nodiscard]] double shown_W() const noexcept { return shown_W_; }

 private:
  struct Part {
    double energy_J = 0.0, span_s = 0.0;
  };
  std::size_t parts_;
  double every_s_, idle_s_;  ///< between readings, and what of that is not read
  std::size_t next_ = 0;
  std::array<Part, static_cast<std::size_t>(most_readings)> passed_{};
  double energy_J_ = 0.0;
  double elapsed_s_ = 0.0, read_s_ = 0.0;
  double shown_W_ = 0.0;
};

}  // namespace feedtwin::plant
