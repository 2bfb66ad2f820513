#pragma once
// What keeps time: friction that beats, sin(2 pi f t + phase) with the sign of the motion, and a force that pulses by the
// clock (a pump, a valve), whatever the motion: such waves of f, 2 f and 3 f. One frequency, phases in each run.

#include <span>
#include <vector>

#include "tools/diagnose/pair_sums.h"
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
  [[nodiscard]] Vector unseen(const Vector& y) const { return unseen(y, 1); }
  /// The same of pulses.
  [[nodiscard]] Vector pulses_unseen(const Vector& y) const;
  /// The frequency, of the waves and of the pulses, that explains most of all folds.
  [[nodiscard]] double wave_Hz(const Vector& y) const { return strongest_Hz(y, 1); }
  [[nodiscard]] double pulses_Hz(const Vector& y) const { return strongest_Hz(in_motion(y), pulse_waves); }

 private:
  static constexpr Index pulse_waves = 3;
  [[nodiscard]] Vector unseen(const Vector& y, Index harmonics) const;
  [[nodiscard]] double strongest_Hz(const Vector& y, Index harmonics) const;
  /// Waves that do not turn with the motion are those of the beat times its sign.
  [[nodiscard]] Vector in_motion(const Vector& y) const;
  [[nodiscard]] std::vector<PairSums> sums_by_fold(const Vector& y) const;  ///< of each run, its folds in turn

  std::vector<BeatMoment> moments_;
  std::size_t folds_, runs_ = 0;
  Eigen::MatrixXd sine_, cosine_;  ///< a row a frequency, a column a moment
};

}  // namespace feedtwin::tools::diagnosis
