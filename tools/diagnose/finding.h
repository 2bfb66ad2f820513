#pragma once
// What the inverse model asks for and the closed loop bears out: names, their sizes, the numbers beside them.

#include <Eigen/Core>
#include <functional>
#include <string_view>

#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

using Progress = std::function<void(std::string_view)>;

struct Finding {
  SearchResult found;
  Fit fit;                     ///< polished by the closed loop where that comes closer
  Fit by_inverse_model;        ///< before that
  Eigen::MatrixXd covariance;  ///< of the unknowns of `fit`
  bool unknown = false;        ///< structure is left that is none of the catalogue
  bool cut_short = false;      ///< the closed loop had simulated as much as it may
};

/// @param fitter takes on the effects that the motor turns out to have of its own
/// @param forward learns the power meter's noise
/// @param given the axis file's
[[nodiscard]] Finding find(Fitter& fitter, ForwardModel& forward, const plant::AxisParameters& given,
                           const Progress& progress);

}  // namespace feedtwin::tools::diagnosis
