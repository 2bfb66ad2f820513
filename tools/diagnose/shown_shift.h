#pragma once
// A sensor that is late shows every jump of the command so many samples later, all of it within two of them, and no model is
// needed to see it. Behind what yields or swings the jump is spread over many.

#include <vector>

#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

/// How a sensor answers a jump of the command: finite impulse response, by least squares over all runs, beside what turns
/// with the direction and the velocity.
struct ShownShift {
  double samples = 0.0;     ///< after which it comes
  double share = 0.0;       ///< of the answer's square that two neighbouring samples hold
  double deviations = 0.0;  ///< of the larger of the two from nothing
};

/// @param reading a sensor of the track; none recorded: nothing is shown
[[nodiscard]] ShownShift shown_shift(const std::vector<Track>& runs, Vector Track::* reading);

/// Is it all the same answer, and later than how a sensor is read could make it?
[[nodiscard]] bool surely_shifted(const ShownShift& shown);

/// Is it all the same answer, a sample later? So is one that is read before the row's command sets in.
[[nodiscard]] bool shown_a_sample_later(const ShownShift& shown);

}  // namespace feedtwin::tools::diagnosis
