#pragma once
// Values in a program: numbers, #parameters, [expressions] and functions (NISTIR 6556, sections 3.3.2.2 - 3.3.2.4).
// Angles are in degrees. Nesting is bounded, so that no text can exhaust the stack.

#include <string>

#include "controllers/gcode/parameters.h"
#include "controllers/gcode/scanner.h"

namespace feedtwin::controllers::gcode {

/// The value that starts here; throws GcodeError. The result is finite.
[[nodiscard]] double read_value(Scanner& scanner, const Parameters& parameters);

/// After '#': the index of a numbered parameter, or the name of a named one.
struct ParameterName {
  int number = 0;  ///< 0: named
  std::string name;
};
[[nodiscard]] ParameterName read_parameter_name(Scanner& scanner, const Parameters& parameters);

}  // namespace feedtwin::controllers::gcode
