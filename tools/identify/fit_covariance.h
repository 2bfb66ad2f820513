#pragma once
// How sure a fit is: the unknowns' covariance, and what the data leave open.

#include <Eigen/Core>
#include <vector>

#include "tools/identify/least_squares.h"
#include "tools/identify/residual_stack.h"

namespace feedtwin::tools {

/// Inverse of the information that data and prior hold.
[[nodiscard]] Eigen::MatrixXd inverse_information(const LeastSquaresSolution& at);

/// That inverse, and more. What whitening left correlated, or of changing size, is taken up by
/// summing the scores over short times (sandwich), all channels of a run together: an encoder's rounding moves the simulated
/// axis, and with it every channel at once. The wider of the two variances counts. What the encoder's rounding moves the fit
/// by (rounding_effect.h) comes on top.
[[nodiscard]] Eigen::MatrixXd covariance_of(const LeastSquaresSolution& at, const ResidualStack& stack,
                                            const Eigen::MatrixXd& inverse, const Eigen::MatrixXd& rounding);

/// Directions in the space of scaled unknowns that the data leave open, each by its largest members.
[[nodiscard]] std::vector<Trade> trades_of(const Eigen::MatrixXd& covariance, const std::vector<FitParameter>& parameters,
                                           double told_below);

}  // namespace feedtwin::tools
