#pragma once
// A finding with one number, as it is told.

#include <string>
#include <string_view>
#include <utility>

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tests {

inline tools::diagnosis::NamedEffect named(std::string_view id, std::string name, double value) {
  tools::diagnosis::NamedEffect effect;
  effect.hypothesis = &tools::diagnosis::hypothesis(id);
  effect.parameters.push_back({std::move(name), {value, value, value}});
  return effect;
}

}  // namespace feedtwin::tests
