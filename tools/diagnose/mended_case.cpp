#include "tools/diagnose/mended_case.h"

#include <string>

#include "tools/diagnose/command_jump.h"

namespace feedtwin::tools::diagnosis {

Case mended(Case data, std::vector<SetupFault>& faults, const std::function<void(std::string_view)>& progress) {
  faults = mend_setup(data);
  for (const auto& fault : faults) progress(fault.sentence);
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
