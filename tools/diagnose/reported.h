#pragma once
// What is told of an effect and of a wrong number: value, interval, where it acts, what else it could be.

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// Friction's laws are never quite the machine's, and that is in no residual's scatter: of 174 numbers in made cases (two
/// sets that were looked at before) intervals of 90 % by the scatter alone held 0.75, twice as wide ones 0.86.
inline constexpr double for_the_laws = 2.0;
/// How long after a reversal an effect that acts there is said to act.
inline constexpr double about_a_reversal_s = 0.05;

/// @param covariance of the base parameters, in tolerances, and then of the effects' working parameters
[[nodiscard]] NamedEffect named_effect(const Found& one, const Fit& fit, const Eigen::MatrixXd& covariance,
                                       const InverseModel& model);

/// What the nominal numbers hold by themselves, told under this name. Where it acts and what it is remain to be said.
/// @param gain what the cost would rise by, were there none of it (Wald)
[[nodiscard]] NamedEffect held_by_numbers(const Hypothesis& name, double gain, const Fit& fit);

/// The nominal numbers that the data move beyond their own uncertainty.
[[nodiscard]] std::vector<Recalibrated> recalibrated(const Fitter& fitter, const Fit& fit,
                                                     const Eigen::MatrixXd& covariance);

}  // namespace feedtwin::tools::diagnosis
