#pragma once
// Counts that an encoder loses at moments of its own, whatever the shaft does: a reading that falls back, or jumps ahead, by
// the same number of counts within one sample, which no machine can. (Losses at a mark of the shaft are a law:
// hypotheses/count_loss.cpp.)

#include <optional>

#include "tools/recording/case.h"

namespace feedtwin::tools::diagnosis {

struct LostCounts {
  double counts = 0.0;     ///< at each moment, lost or gained
  double deviation = 0.0;  ///< of that number
  double per_s = 0.0;      ///< moments
  int moments = 0, gained = 0;
};

/// Finds them in the runs of the fit and gives them back in all recordings: then the encoder shows where the shaft was, and
/// the reference steps as the controller saw its error step.
[[nodiscard]] std::optional<LostCounts> give_back_lost_counts(Case& data);

}  // namespace feedtwin::tools::diagnosis
