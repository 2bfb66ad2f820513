#include "tools/diagnose/forward/confirm.h"

#include "tools/diagnose/forward/extended_axis.h"

namespace feedtwin::tools::diagnosis {

Confirmation confirm(const ForwardModel& forward, const Fitter& fitter, const Whitening& whitening, const Candidate& model,
                     std::size_t effect) {
  constexpr int iterations = 4;
  Candidate less = model;
  less.effects.erase(less.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  less = fitter.fit(less, whitening, iterations).model;  // its numbers may take up what they can
  const auto with = forward.nrmse(extended(model)), without = forward.nrmse(extended(less));
  Confirmation found;
  for (const auto& [channel, error] : with)
    if (error > 0.0 && without.at(channel) > found.error_ratio * error) found = {channel, without.at(channel) / error};
  return found;
}

}  // namespace feedtwin::tools::diagnosis
