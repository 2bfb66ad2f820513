#pragma once
// A table's mass that is further off than any number of a data sheet. The nominal mass can follow, so that no hypothesis
// needs to be asked; but half as much again is no wrong number: it is a load that the axis file left out, and is told so.

#include <optional>

#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// What the recalibrated table has more than the nominal one.
/// @param covariance of the base parameters, in tolerances, first
/// @return none where that is no more than a number may be off, or the recording does not say it that well
[[nodiscard]] std::optional<NamedEffect> payload_in_mass(const Fitter& fitter, const Fit& fit,
                                                         const Eigen::MatrixXd& covariance);

/// Adds what the recalibrated table holds to what is told. Where the lead was wrong and the file's numbers were fitted under
/// it, a mass that is off says nothing of a load: then none is told.
void tell_load(Diagnosis& told, const Fitter& fitter, const Fit& fit, const Eigen::MatrixXd& covariance);

}  // namespace feedtwin::tools::diagnosis
