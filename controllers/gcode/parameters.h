#pragma once
// The variables of a program: numbered #1 .. #5601 (0 until set) and named #<name>.

#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace feedtwin::controllers::gcode {

/// Numbered parameters with a fixed meaning, in millimetres (NISTIR 6556, table 2).
inline constexpr int home_parameter = 5161;          ///< G28: x, y, z
inline constexpr int first_offset_parameter = 5221;  ///< G54: x, y, z; each further system 20 on
inline constexpr int parameters_per_system = 20;
inline constexpr int parameter_count = 5602;

/// Numbered parameters; 0 until set. Few of the thousands are ever used.
class NumberedParameters {
 public:
  double& operator[](std::size_t index) { return values_[index]; }
  double operator[](std::size_t index) const {
    const auto found = values_.find(index);
    return found == values_.end() ? 0.0 : found->second;
  }

 private:
  std::map<std::size_t, double> values_;
};

struct Parameters {
  NumberedParameters numbered;
  std::map<std::string, double, std::less<>> named;
};

}  // namespace feedtwin::controllers::gcode
