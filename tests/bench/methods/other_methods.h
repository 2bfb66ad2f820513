#pragma once
// General integrators on the reference's equations (tests/golden), each as a user would set it up: stopped where the
// velocity changes its sign, restarted at every tick because the command jumps there.

#include "tests/golden/feed_drive.h"

namespace feedtwin::bench {

/// Boost.Odeint's Dormand-Prince 5(4) with step control.
class DormandPrinceAxis {
 public:
  explicit DormandPrinceAxis(double tolerance) : tolerance_(tolerance) {}
  void tick(double force_N, double tick_s);
  [[nodiscard]] const golden::State& state() const { return y_; }

 private:
  golden::FeedDrive drive_;
  double tolerance_, step_s_ = 1e-5;
  golden::State y_{};
};

/// Boost.Odeint's Rosenbrock 4 with step control; Jacobian by differences of the three unknowns that matter.
class RosenbrockAxis {
 public:
  explicit RosenbrockAxis(double tolerance) : tolerance_(tolerance) {}
  void tick(double force_N, double tick_s);
  [[nodiscard]] const golden::State& state() const { return y_; }

 private:
  golden::FeedDrive drive_;
  double tolerance_, step_s_ = 1e-5;
  golden::State y_{};
};

/// Explicit Euler.
class EulerAxis {
 public:
  explicit EulerAxis(int steps_per_tick) : steps_(steps_per_tick) {}
  void tick(double force_N, double tick_s);
  [[nodiscard]] const golden::State& state() const { return y_; }

 private:
  golden::FeedDrive drive_;
  int steps_;
  golden::State y_{};
};

}  // namespace feedtwin::bench
