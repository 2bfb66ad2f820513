#pragma once
// The case as both engines take it: without what is wrong in its set-up.

#include <functional>
#include <string_view>
#include <vector>

#include "tools/diagnose/setup_checks.h"
#include "tools/recording/case.h"

namespace feedtwin::tools::diagnosis {

/// And with laws of friction on the contact that has it.
/// @param faults takes what was mended
[[nodiscard]] Case mended(Case data, std::vector<SetupFault>& faults, const std::function<void(std::string_view)>& progress);

/// How much of a jump of the command the force sensor shows at once, of what it would on one body; less where the screw
/// yields.
[[nodiscard]] JumpShares shown_jump_shares(const Case& data, const std::function<void(std::string_view)>& progress);

/// With the lead that a fault says, and the positions too where it says so of them.
[[nodiscard]] Case with_lead(Case data, const SetupFault& wrong_lead);

/// For the simulation of the runs.
void note_reading(Case& data, const JumpShares& shares);

}  // namespace feedtwin::tools::diagnosis
