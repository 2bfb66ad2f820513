#pragma once
// What of a power remainder is no meter's noise: powers that the recorded command and motion could make in any drive. A
// meter's noise is far below what a wrong number leaves over, so that the remainder itself cannot tell it.

#include "tools/diagnose/reading_rows.h"

namespace feedtwin::tools::diagnosis {

class PowerStructure {
 public:
  explicit PowerStructure(const InverseModel& model);

  /// What of the power equation's residual is predicted on seconds that the prediction has not seen; zero elsewhere, and
  /// where nothing is.
  [[nodiscard]] Vector part_of(const Vector& residual) const;

 private:
  ReadingRows rows_;  ///< of the power equation, all runs in turn
};

}  // namespace feedtwin::tools::diagnosis
