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

/// Were the file's numbers fitted under the lead that it has wrong? Then all are off by what the lead is off, friction by
/// more than a data sheet's could be, and a mass that is off says nothing of a load.
/// @param lead_mended a wrong lead was found, and the axis has the right one
[[nodiscard]] bool numbers_of_another_lead(const Fitter& fitter, const plant::AxisParameters& axis, bool lead_mended);

/// Adds what the recalibrated table holds to what is told; takes a load from it whose size says nothing.
void tell_load(Diagnosis& told, const Fitter& fitter, const Fit& fit, const Eigen::MatrixXd& covariance);

}  // namespace feedtwin::tools::diagnosis
