#pragma once
// What is told of an effect and of a wrong number: value, interval, where it acts, what else it could be.

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// @param covariance of the base parameters, in tolerances, and then of the effects' working parameters
[[nodiscard]] NamedEffect named_effect(const Found& one, const Fit& fit, const Eigen::MatrixXd& covariance,
                                       const InverseModel& model);

/// A lead that the set-up check has mended: what is left of its error is told with it, not as another finding.
void tell_as_one_lead(Diagnosis& result);

/// The nominal numbers that the data move beyond their own uncertainty.
[[nodiscard]] std::vector<Recalibrated> recalibrated(const Fitter& fitter, const Fit& fit,
                                                     const Eigen::MatrixXd& covariance);

}  // namespace feedtwin::tools::diagnosis
