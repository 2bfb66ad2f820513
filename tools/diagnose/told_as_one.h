#pragma once
// Names that the model keeps apart and the machine does not: what is one finding is told as one.

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// A lead that was mended, and what was still off of it.
void tell_as_one_lead(Diagnosis& result);
/// What wavers with the shaft and is no pure sine: its second or third harmonic found another name, that it is confused
/// with.
void tell_as_one_wave(Diagnosis& result);
/// Cogging seen from where the shaft is not: what yields between them turns further the harder the motor pulls, so that a
/// ripple of cogging's own order stands beside it, a quarter of a period away.
void tell_as_one_cogging(Diagnosis& result);
/// Friction that changes as the screw warms and as time goes by, or lags behind speed and behind velocity: of the two the
/// one that explains more.
void tell_as_one_change(Diagnosis& result);
/// Friction that grows along the stroke and goes up and down along it: of the two the one that explains more, with the
/// numbers of both.
void tell_as_one_friction_along(Diagnosis& result);
/// A screw that grows, and had grown before: a lead error of the same sign, of no more than what the runs show it to grow
/// by.
/// @param run_s length of a run
void tell_as_one_growth(Diagnosis& result, double run_s);
/// All of these.
void tell_as_one(Diagnosis& result, double run_s);

}  // namespace feedtwin::tools::diagnosis
