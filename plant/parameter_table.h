#pragma once
// Every number of an axis by its name in an axis file: the one table from which files are read and written, parameters
// identified and reports made. A new key is one line in parameter_table.cpp.

#include <optional>
#include <span>
#include <string_view>

#include "plant/parameters.h"

namespace feedtwin::plant {

/// One key of an axis file.
struct ParameterEntry {
  std::string_view key;  ///< "ball_screw.coulomb_pos_N": table, symbol, direction, unit
  double& (*in)(AxisParameters&);
  double lowest, highest;        ///< admitted range, both ends included
  std::optional<double> preset;  ///< value where the key is missing; none: the key is required
  std::string_view meaning;
};

[[nodiscard]] std::span<const ParameterEntry> parameter_table() noexcept;

/// The entry of a key, or nullptr.
[[nodiscard]] const ParameterEntry* find_parameter(std::string_view key) noexcept;

/// The source paper's axis, Table 2.
[[nodiscard]] AxisParameters source_axis() noexcept;

}  // namespace feedtwin::plant
