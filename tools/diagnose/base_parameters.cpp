#include "tools/diagnose/base_parameters.h"

#include <algorithm>

namespace feedtwin::tools::diagnosis {

std::vector<BaseParameter> base_parameters(bool power_recorded) {
  std::vector<BaseParameter> found;
  for (const auto& entry : plant::parameter_table()) {
    const auto key = entry.key;
    const bool axis = key.starts_with("axis.") || key.starts_with("power.");
    const bool electrical = key.starts_with("motor.ke");
    if (axis || key == "motor.rated_torque_Nm" || (electrical && !power_recorded)) continue;
    const bool contact = key.starts_with("ball_screw.") || key.starts_with("guide.");
    const bool inertia = key.ends_with("inertia_kgm2") || key.ends_with("mass_kg");
    const bool presliding = key.find("sigma") != std::string_view::npos;
    const bool stribeck = key.find("stribeck") != std::string_view::npos;
    const double tolerance = presliding ? 0.4 : stribeck ? 0.3 : 0.1;
    found.push_back({&entry, tolerance, contact && !inertia, electrical, presliding || stribeck});
  }
  return found;
}

double value_of(const BaseParameter& parameter, const plant::AxisParameters& axis) {
  plant::AxisParameters copy = axis;
  return parameter.entry->in(copy);
}

void set_value(const BaseParameter& parameter, plant::AxisParameters& axis, double value) {
  parameter.entry->in(axis) = std::clamp(value, parameter.entry->lowest, parameter.entry->highest);
}

}  // namespace feedtwin::tools::diagnosis
