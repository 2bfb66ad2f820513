#pragma once
// The variables of a program: numbered #1 .. #5601 (0 until set) and named #<name>.

#include <map>
#include <string>
#include <vector>

namespace feedtwin::controllers::gcode {

/// Numbered parameters with a fixed meaning, in millimetres (NISTIR 6556, table 2).
inline constexpr int home_parameter = 5161;          ///< G28: x, y, z
inline constexpr int first_offset_parameter = 5221;  ///< G54: x, y, z; each further system 20 on
inline constexpr int parameters_per_system = 20;
inline constexpr int parameter_count = 5602;

struct Parameters {
  std::vector<double> numbered = std::vector<double>(parameter_count, 0.0);
  std::map<std::string, double, std::less<>> named;
};

}  // namespace feedtwin::controllers::gcode
