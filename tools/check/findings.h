#pragma once
// Whether the host's facts are fit for a plant in real time, and what to change where they are not. Pure.

#include <string>
#include <vector>

#include "tools/check/host_facts.h"

namespace feedtwin::tools {

enum class Fitness {
  fit,
  improvable,  ///< works, with worse latency or without an option
  unfit,       ///< a run can't be valid for latency
};

struct Finding {
  std::string what, found;
  Fitness fitness = Fitness::fit;
  std::string change;  ///< what to do; empty where nothing has to be done
};

[[nodiscard]] std::vector<Finding> findings_on(const HostFacts& facts);
[[nodiscard]] bool fit_for_real_time(const std::vector<Finding>& findings);

}  // namespace feedtwin::tools
