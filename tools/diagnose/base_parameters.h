#pragma once
// The nominal model's numbers that a recording can correct, each with the tolerance that a nominal number has.

#include <string_view>
#include <vector>

#include "plant/parameter_table.h"

namespace feedtwin::tools::diagnosis {

struct BaseParameter {
  const plant::ParameterEntry* entry = nullptr;
  double tolerance = 0.0;       ///< standard deviation, as a share of the nominal value
  bool moves_friction = false;  ///< friction must be followed again when it changes
  bool only_power = false;
  bool known_to_a_factor = false;  ///< of its logarithm: Stribeck velocities, bristles
};

/// The keys that recalibration may touch, in the table's order.
[[nodiscard]] std::vector<BaseParameter> base_parameters(bool power_recorded);

[[nodiscard]] double value_of(const BaseParameter& parameter, const plant::AxisParameters& axis);
void set_value(const BaseParameter& parameter, plant::AxisParameters& axis, double value);

}  // namespace feedtwin::tools::diagnosis
