#pragma once
// What pulses by the clock in any shape - a hose, a lubricator, a valve: short beside the time between, so that no few waves
// make it. The time is folded at each of many periods; a mean for each part of one, in each run.

#include <cstdint>
#include <span>
#include <vector>

#include "tools/diagnose/beat.h"

namespace feedtwin::tools::diagnosis {

class Folded {
 public:
  Folded(std::span<const BeatMoment> moments, std::size_t folds);

  /// What the period that explains most of the other folds predicts of each.
  [[nodiscard]] Vector unseen(const Vector& y) const;
  /// The period that explains most of all folds.
  [[nodiscard]] double period_s(const Vector& y) const;

 private:
  static constexpr std::size_t parts = 24;
  /// Sums and counts of each part of a period, run by run.
  struct Sums {
    Eigen::ArrayXd y, count;
  };
  [[nodiscard]] std::size_t place(std::size_t period, std::size_t moment) const {
    return run_[moment] * parts + part_[period * run_.size() + moment];
  }
  [[nodiscard]] static Sums sum_of(const std::vector<Sums>& by_fold);
  [[nodiscard]] std::vector<Sums> sums_by_fold(const Vector& y, std::size_t period) const;

  std::size_t folds_, runs_ = 0;
  std::vector<std::size_t> run_, fold_;
  std::vector<std::uint8_t> part_;  ///< of each period, of each moment
};

}  // namespace feedtwin::tools::diagnosis
