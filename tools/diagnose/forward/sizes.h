#pragma once
// How large the closed loop finds each effect, once polished, and which have no size there.

#include <functional>
#include <string_view>

#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

/// The closed loop's covariance; the inverse model's own where a number moves nothing there by small steps, whole counts,
/// or is none of the closed loop's unknowns.
[[nodiscard]] Eigen::MatrixXd with_what_only_inverse_tells(Eigen::MatrixXd covariance,
                                                           const Eigen::MatrixXd& by_inverse_model, const Candidate& model,
                                                           Index base_count);

/// Takes back names for which the closed loop finds no size: no channel changes when the effect goes, its interval holds
/// nothing and the other numbers can take up what it does, or it is a small part of what the inverse model found; but not
/// where it is missed by hundreds of nats. And those that came out at a size that cannot be, or nearer to nothing than
/// `Hypothesis::least_deviations`, however much they are missed. Their rows leave the covariance too.
void drop_sizeless(const ForwardModel& forward, const Fitter& fitter, const Candidate& by_inverse_model, SearchResult& found,
                   Fit& fit, Eigen::MatrixXd& covariance, const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
