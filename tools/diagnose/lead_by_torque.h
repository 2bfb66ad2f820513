#pragma once
// A wrong lead in the axis file where the positions are right already: F = 2 pi T / lead, so that against all that happens
// at the table the command and the torque sensor are off by one and the same factor.

#include <optional>

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// Told as a torque constant and a torque sensor's gain that undo each other it is the lead: nobody's motor and sensor agree
/// so by chance. Nothing where they do not.
[[nodiscard]] std::optional<SetupFault> lead_by_torque(const Diagnosis& told);

}  // namespace feedtwin::tools::diagnosis
