#pragma once
// Friction that beats with time: sin(2 pi f t + phase) with the sign of the motion, one frequency, a phase in each run.

#include <span>
#include <vector>

#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

struct BeatMoment {
  double time_s = 0.0;
  bool forth = true;
  std::size_t run = 0, fold = 0;
};

class Beat {
 public:
  Beat(std::span<const BeatMoment> moments, std::size_t folds);

  /// What the frequency and phases that explain most of the other folds predict of each.
  [[nodiscard]] Vector unseen(const Vector& y) const;

 private:
  std::vector<BeatMoment> moments_;
  std::size_t folds_, runs_ = 0;
  Eigen::MatrixXd sine_, cosine_;  ///< a row a frequency, a column a moment
};

}  // namespace feedtwin::tools::diagnosis
