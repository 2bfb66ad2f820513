#pragma once
// How well a model explains runs, channel by channel, and where their energy goes.

#include <map>
#include <string>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// A model followed along the runs, once for all of its figures.
struct Followed {
  const InverseModel& runs;
  const plant::AxisParameters& axis;
  InverseModel::Prepared model;
};
/// @param runs,model must outlive it
[[nodiscard]] Followed followed(const InverseModel& runs, const Candidate& model);
Followed followed(const InverseModel& runs, Candidate&& model) = delete;  // it would be gone

/// |y - s| / |y - mean y| by channel, through the inverse model's low pass.
using Nrmse = std::map<std::string, double>;
[[nodiscard]] Nrmse nrmse(const Followed& at);
/// What a model's effects make of it: |s - s without them| / |y - mean y|, the numbers as they are.
[[nodiscard]] Nrmse made_by_effects(const Followed& at);
/// What the encoder's grid and the sensors' own noise leave of it.
[[nodiscard]] Nrmse noise_floor(const Followed& at);

/// |f - m| / |f| of the commanded force f, decimated to 40 Hz as for the published fits of EMPS (Janot, Gautier, Brunot
/// 2019); the motion is smoothed otherwise than theirs.
[[nodiscard]] double relative_force_error(const Followed& at);

/// Work taken by each component over the runs, J.
using Energy = std::map<std::string, double>;
[[nodiscard]] Energy energy(const Followed& at);

}  // namespace feedtwin::tools::diagnosis
