#pragma once
// What to record next, where the data leave a question open, and the chance that it answers it.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/diagnose/forward/forward_model.h"

namespace feedtwin::tools::diagnosis {

struct NextExperiment {
  std::string move;
  std::vector<std::string> separates;
  std::optional<double> p_resolve;  ///< none where nothing is open, or where no simulation can say
};

/// What the recordings say, as far as planning needs it.
struct Evidence {
  const Case& data;
  const ForwardModel& forward;
  const Fitter& fitter;
  const Whitening& whitening;
  const Candidate& model;
};

/// Told apart: an effect of the model from each of those that could stand in its place.
[[nodiscard]] NextExperiment plan_to_separate(const Evidence& seen, const Hypothesis& effect,
                                              const std::vector<std::string>& alternatives,
                                              const std::function<void(std::string_view)>& progress);

/// Raised above the noise: effects that the recordings suspect and cannot prove, the strongest first.
/// @param suspects the model with each of them fitted, as its last effect
[[nodiscard]] NextExperiment plan_to_prove(const Evidence& seen, const std::vector<Candidate>& suspects,
                                           const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
