#pragma once
// One effect that is switched on in an axis: its id and its numbers, as an axis file holds them.

#include <string>
#include <vector>

namespace feedtwin::plant {

/// `values` and `lists` follow the order of the registry entry's scalar and list parameters.
struct EffectSetting {
  std::string id;
  std::vector<double> values;              ///< one for each scalar parameter
  std::vector<std::vector<double>> lists;  ///< one for each list parameter (learned tables alone have any)

  bool operator==(const EffectSetting&) const = default;
};

}  // namespace feedtwin::plant
