#include "tests/golden/runge_kutta_axis.h"

#include <algorithm>

namespace feedtwin::golden {

State RungeKuttaAxis::stepped(Mode mode, double force_N, double h_s) const {
  const auto plus = [this](const State& k, double by) {
    State y = y_;
    for (std::size_t i = 0; i < unknowns; ++i) y[i] += by * k[i];
    return y;
  };
  State k1, k2, k3, k4;
  derivative(drive_, mode, force_N, y_.data(), k1.data());
  derivative(drive_, mode, force_N, plus(k1, 0.5 * h_s).data(), k2.data());
  derivative(drive_, mode, force_N, plus(k2, 0.5 * h_s).data(), k3.data());
  derivative(drive_, mode, force_N, plus(k3, h_s).data(), k4.data());
  State y = y_;
  for (std::size_t i = 0; i < unknowns; ++i) y[i] += h_s / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
  return y;
}

void RungeKuttaAxis::advance(double force_N, double h_s) {
  const double v = y_[velocity];
  Mode mode = v > 0.0 ? Mode::forward : Mode::backward;
  if (v == 0.0) mode = mode_from_rest(drive_, y_, force_N);
  if (mode == Mode::stuck) {
    y_[electrical_loss] += drive_.ke0_W * h_s;
    return;
  }
  State next = stepped(mode, force_N, h_s);
  const bool crossed = mode == Mode::forward ? next[velocity] < 0.0 : next[velocity] > 0.0;
  if (!crossed) {
    y_ = next;
    return;
  }
  const double fraction = v / (v - next[velocity]);
  next = stepped(mode, force_N, h_s * fraction);
  next[velocity] = 0.0;
  y_ = next;
  if (v != 0.0) advance(force_N, h_s * (1.0 - fraction));
}

void RungeKuttaAxis::tick(double force_N, double tick_s) {
  for (int i = 0; i < steps_; ++i) advance(force_N, tick_s / steps_);
}

}  // namespace feedtwin::golden
