#pragma once
// A part of the machine on a light damper, which the table's acceleration a sets swinging and which pushes back:
//
//   z'' + 2 d w z' + w^2 z = -a,   F = A z + B z'
//
// for one frequency w / 2 pi and damping ratio d. It swings on long after what set it off, so that no table over the
// recent past holds it; and unlike noise of that colour it follows from the motion.

#include <optional>
#include <span>
#include <vector>

#include "tools/diagnose/pair_sums.h"
#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

/// A row: a sample of a run, and the fold that judges it.
struct RingingMoment {
  std::size_t run = 0, fold = 0;
  Index sample = 0;
};

/// A part of mass_kg that hangs on the table so: A = -mass w^2, B = -2 mass d w, as a load. Less than none: no such part.
struct Mode {
  double frequency_Hz = 0.0, damping_ratio = 0.0, mass_kg = 0.0;
};

class Ringing {
 public:
  /// @param tracks of the runs, from rest
  Ringing(const std::vector<Track>& tracks, std::span<const RingingMoment> moments, std::size_t folds);

  /// What the mode that explains most of the other folds predicts of each.
  [[nodiscard]] Vector unseen(const Vector& y) const;
  /// The one that explains most of all of a load.
  [[nodiscard]] Mode mode(const Vector& y) const;

 private:
  [[nodiscard]] std::vector<PairSums> sums_by_fold(const Vector& y) const;

  std::vector<std::size_t> fold_;
  std::size_t folds_;
  Eigen::MatrixXd swing_, speed_;  ///< a row a mode, a column a moment: z and z', of unit size each
  std::vector<double> size_;       ///< that they had
};

}  // namespace feedtwin::tools::diagnosis
