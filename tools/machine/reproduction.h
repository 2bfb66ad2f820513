#pragma once
// The source's numbers beside this program's: Tables 3-5, Figs. 7-11, Eq. 15, from one configuration.

#include <string>
#include <vector>

#include "tools/machine/machine_run.h"
#include "tools/machine/sweep.h"

namespace feedtwin::tools {

struct ReproducedNumber {
  std::string where, quantity, unit;
  double source = 0.0, ours = 0.0;
  std::string reason;   ///< why they differ; empty where nothing needs saying
  bool target = false;  ///< one that is to be met within 5 %
  [[nodiscard]] double deviation() const noexcept { return ours / source - 1.0; }
};

struct Reproduction {
  MachineResult case_a, case_b;
  std::vector<SweepPoint> sweep;
  SpecificEnergyFit fit;
  std::vector<ReproducedNumber> numbers;
  [[nodiscard]] bool targets_met() const noexcept;
};

/// What the source does not give and this configuration had to choose.
[[nodiscard]] const std::vector<std::string>& free_choices();

[[nodiscard]] Reproduction make_reproduction(unsigned threads);

/// Runs it, prints the table and writes the page and the JSON. Ends with not_so where a target is missed.
int reproduce(const std::string& page_path, const std::string& json_path, unsigned threads);

}  // namespace feedtwin::tools
