#pragma once
// The middle one of some values; of an even number the higher of the two.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace feedtwin::tools {

/// @param values not empty
template <class Value>
[[nodiscard]] Value median_of(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace feedtwin::tools
