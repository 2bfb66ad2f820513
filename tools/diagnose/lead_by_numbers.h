#pragma once
// A wrong lead in the axis file where the positions were computed with it and no scale says otherwise. The numbers can take
// it up, each by a power of the same factor: of a lead r times the file's, v is shown as v / r and F as r F, so that
// friction goes with r, what is divided by a speed, a path or an acceleration with r^2, a Stribeck velocity with 1 / r, and
// what the motor's angle alone tells stays. Nobody's numbers are wrong so by chance.

#include <optional>

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// By the numbers that the recalibration moved, where one factor explains nearly all of how far they are off. Its `factor`
/// is what lead and positions are to be multiplied with.
[[nodiscard]] std::optional<SetupFault> lead_by_numbers(const Diagnosis& told);

}  // namespace feedtwin::tools::diagnosis
