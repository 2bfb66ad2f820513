#pragma once
// Which hypotheses the recording asks for: one by one and in pairs, each judged with all numbers floating, each asked again
// at the end whether it is still needed, and what else could have taken its place.

#include <functional>
#include <string_view>
#include <vector>

#include "tools/diagnose/screen.h"

namespace feedtwin::tools::diagnosis {

/// What a hypothesis must do to be named.
struct Bar {
  double p_false_alarm = 0.005;      ///< over all hypotheses together
  double share = 0.04;               ///< of what the model before it leaves over, whitened
  double smallest_residual_N = 0.5;  ///< where less is left over, as much is asked for as if it were this
  double share_if_absorbed = 0.12;   ///< likewise for what the nominal numbers can nearly do
  double nominal_surprise = 40.0;    ///< or: fall of the squared deviations of the nominal numbers, in tolerances
  double lost_when_dropped = 0.03;   ///< share that must come back when it is taken out again
  std::size_t most_effects = 6;
};

struct Found {
  Active effect;
  double gain = 0.0;   ///< fall of the cost that it brings, everything else refitted
  double share = 0.0;  ///< of the cost without it
  double p_false_alarm = 1.0;
  std::vector<const Hypothesis*> rivals;  ///< fit as well in its place
};

struct SearchResult {
  Fit recalibrated;  ///< without any effect
  Fit final;
  Whitening whitening;  ///< of the final fit
  std::vector<Found> found;
  Screen last;  ///< what the final model leaves over
};

/// @param progress called with what is being done
[[nodiscard]] SearchResult search(const Fitter& fitter, const Bar& bar,
                                  const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
