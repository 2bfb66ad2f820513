#pragma once
// Friction that the axis file has the same in both directions, and that is not. Its numbers can follow, so that no
// hypothesis needs to be asked; but who wrote one number for both left the difference out, and is told so.

#include <optional>

#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// The difference of all Coulomb friction, forth less back, and of all viscous friction, from the recalibrated numbers.
/// @param covariance of the base parameters, in tolerances, first
/// @return none where the file's friction differs by direction itself, or the numbers do so by no more than they may
[[nodiscard]] std::optional<NamedEffect> difference_by_direction(const Fitter& fitter, const Fit& fit,
                                                                 const Eigen::MatrixXd& covariance);

}  // namespace feedtwin::tools::diagnosis
