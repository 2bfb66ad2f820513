#pragma once
// The feed drive by SUNDIALS CVODE (BDF, dense Newton) with root finding at v = 0, started afresh each tick because the
// command jumps there.

#include <memory>

#include "tests/golden/feed_drive.h"

namespace feedtwin::golden {

class CvodeAxis {
 public:
  explicit CvodeAxis(const FeedDrive& drive, double relative_tolerance = 1e-10);
  ~CvodeAxis();
  CvodeAxis(CvodeAxis&&) noexcept;

  /// Throws std::runtime_error where CVODE gives up.
  void tick(double force_N, double tick_s);
  [[nodiscard]] const State& state() const;
  void set_state(const State& y);
  /// Steps that end on a stop and reversals so far, so that a test can tell that there were any.
  [[nodiscard]] int sticks() const;
  [[nodiscard]] int reversals() const;

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace feedtwin::golden
