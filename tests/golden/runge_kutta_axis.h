#pragma once
// The feed drive by the classical fourth-order Runge-Kutta rule at tiny fixed steps: the second opinion on the reference.

#include "tests/golden/feed_drive.h"

namespace feedtwin::golden {

class RungeKuttaAxis {
 public:
  RungeKuttaAxis(const FeedDrive& drive, int steps_per_tick) : drive_(drive), steps_(steps_per_tick) {}
  void tick(double force_N, double tick_s);
  [[nodiscard]] const State& state() const { return y_; }
  void set_state(const State& y) { y_ = y; }

 private:
  [[nodiscard]] State stepped(Mode mode, double force_N, double h_s) const;
  void advance(double force_N, double h_s);

  FeedDrive drive_;
  int steps_;
  State y_{};
};

}  // namespace feedtwin::golden
