#pragma once
// How well a model explains runs, channel by channel, and where their energy goes.

#include <map>
#include <string>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// |y - s| / |y - mean y| by channel, through the inverse model's low pass.
using Nrmse = std::map<std::string, double>;
[[nodiscard]] Nrmse nrmse(const InverseModel& model, const Candidate& at);
/// What the encoder's grid and the sensors' own noise leave of it.
[[nodiscard]] Nrmse noise_floor(const InverseModel& model, const Candidate& at);

/// |f - m| / |f| of the commanded force f, decimated to 40 Hz as for the published fits of EMPS (Janot, Gautier, Brunot
/// 2019); the motion is smoothed otherwise than theirs.
[[nodiscard]] double relative_force_error(const InverseModel& model, const Candidate& at);

/// Work taken by each component over the runs, J.
using Energy = std::map<std::string, double>;
[[nodiscard]] Energy energy(const InverseModel& model, const Candidate& at);

}  // namespace feedtwin::tools::diagnosis
