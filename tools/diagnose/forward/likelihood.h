#pragma once
// How likely the runs are under an axis, by closed-loop simulation: each channel's residuals as an autoregressive process of
// their own colour, driven by Student's t. Kept by stretches of time, so that two models can be compared stretch by stretch
// (Vuong 1989): a difference that the stretches do not agree about says nothing.

#include <vector>

#include "tools/diagnose/forward/forward_model.h"

namespace feedtwin::tools::diagnosis {

struct Likelihood {
  std::vector<double> stretches;  ///< log likelihood of each, all channels of a run together

  [[nodiscard]] double total() const;
};

[[nodiscard]] Likelihood likelihood(const ForwardModel& forward, const AxisByRun& axis);

/// How much likelier the first is, and how far beyond the scatter over the stretches.
struct Comparison {
  double nats = 0.0, deviations = 0.0;
};
[[nodiscard]] Comparison compared(const Likelihood& one, const Likelihood& other);

}  // namespace feedtwin::tools::diagnosis
