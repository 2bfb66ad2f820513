#pragma once
// A diagnosis as JSON, in the form that scripts rely on.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/hil.h"

namespace feedtwin::tools::diagnosis {

[[nodiscard]] nlohmann::json to_json(const Diagnosis& diagnosis, const std::string& updated_axis);
[[nodiscard]] nlohmann::json to_json(const HilComparison& hil);

}  // namespace feedtwin::tools::diagnosis
