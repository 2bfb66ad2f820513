#pragma once
// A name that goes may have stood where another belongs: that one was never asked for beside what is left.

#include <functional>
#include <string_view>
#include <vector>

#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

/// Asks the inverse model for what the names that went have hidden, and the closed loop whether it bears that out. Nothing
/// is asked where none went, nor again for what went; where no name comes all stays as it was. A torque constant that stood
/// for a copper loss of 24.6 W/(N m)^2 was not missed in closed loop; the loss was.
/// @param before names before some went
/// @return true where a name came
bool name_what_they_hid(const std::vector<Active>& before, const ForwardModel& forward, const Fitter& fitter,
                        SearchResult& found, Fit& fit, const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
