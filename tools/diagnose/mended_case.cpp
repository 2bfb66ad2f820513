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

double shown_jump_share(const Case& data, const std::function<void(std::string_view)>& progress) {
  const double share = force_jump_share(data.fit, data.axis);
  if (share < 1.0) progress("the screw yields: the force sensor does not show the command's jumps at once");
  return share;
}

}  // namespace feedtwin::tools::diagnosis
