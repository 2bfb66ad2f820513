#include "tools/diagnose/mended_case.h"

#include <string>

#include "tools/diagnose/command_jump.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// A direct drive has hardly a friction but its guide's; what changes friction changes that. A file that says so already, or
/// holds effects that its own laws stand for, stays as it is.
bool hardly_any_friction_but_the_guides(const plant::AxisParameters& axis) {
  constexpr double least_ratio = 4.0;
  return !axis.laws_on_guide() && axis.effects.empty() &&
         mean(axis.guide.coulomb_N) > least_ratio * mean(axis.ball_screw.coulomb_N);
}

}  // namespace

Case mended(Case data, std::vector<SetupFault>& faults, const std::function<void(std::string_view)>& progress) {
  faults = mend_setup(data);
  for (const auto& fault : faults) progress(fault.sentence);
  if (hardly_any_friction_but_the_guides(data.axis)) {
    data.axis.axis.friction_laws_on_guide = 1.0;
    progress("the axis file gives the guide nearly all friction: drift, dwell, warm-up and place change that");
  }
  progress("following friction along " + std::to_string(data.fit.size()) + " runs");
  return data;
}

JumpShares shown_jump_shares(const Case& data, const std::function<void(std::string_view)>& progress) {
  const JumpShares shares = jump_shares(data.fit, data.axis);
  if (shares.before_command) {
    progress("torque and force sensor are read before the row's command sets in");
    return shares;
  }
  if (shares.force < 1.0) progress("the screw yields: the force sensor does not show the command's jumps at once");
  if (shares.torque < 1.0)
    progress("the screw yields: at once the torque sensor shows what the screw's own inertia takes of the command's jumps");
  return shares;
}

Case with_lead(Case data, const SetupFault& wrong_lead) {
  const double factor = wrong_lead.parameters.front().value;
  data.axis.axis.lead_m *= factor;
  if (wrong_lead.channel == channel::position_m) multiply(data, channel::position_m, factor);
  return data;
}

void note_reading(Case& data, const JumpShares& shares) {
  for (auto* runs : {&data.fit, &data.holdout})
    for (auto& run : *runs) run.forces_before_command = shares.before_command;
}

}  // namespace feedtwin::tools::diagnosis
