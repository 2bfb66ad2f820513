#pragma once
// Axis files in TOML: the keys of plant/parameter_table, and the effects that are switched on, each a table named by its id
// (plant/effects/registry.h):
//
//   [effects.backlash]          one
//   gap_m = 4e-6
//   [[effects.cogging]]         several of a kind
//   amplitude_Nm = 0.025
//   cycles_per_rev = 12

#include <string>

#include "plant/parameters.h"
#include "tools/config/toml_file.h"

namespace feedtwin::tools {

/// The axis in an open file; throws InputError. Leaves other keys to the caller, who then calls reject_unknown().
[[nodiscard]] plant::AxisParameters axis_from(TomlFile& file);

/// A file that holds an axis and nothing else.
[[nodiscard]] plant::AxisParameters read_axis_file(const std::string& path);

/// Writes every key and every effect, each with what it means. Throws InputError when the file can't be written.
void write_axis_file(const std::string& path, plant::AxisParameters parameters);

}  // namespace feedtwin::tools
