#pragma once
// The G and M codes of one line by modal group: at most one of each, but for M7 beside M8.

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "controllers/gcode/block.h"
#include "controllers/gcode/modal_groups.h"

namespace feedtwin::controllers::gcode {

/// The codes of one line by group.
struct Codes {
  std::array<std::optional<Code>, static_cast<std::size_t>(GGroup::count)> g;
  std::array<std::optional<Code>, static_cast<std::size_t>(MGroup::count)> m;
  bool machine_coordinates = false;  // G53, beside a motion
  bool mist = false, flood = false;  // M7 and M8 may stand together

  [[nodiscard]] const std::optional<Code>& operator[](GGroup group) const { return g[static_cast<std::size_t>(group)]; }
  [[nodiscard]] const std::optional<Code>& operator[](MGroup group) const { return m[static_cast<std::size_t>(group)]; }
};

/// Throws GcodeError on a code that is not supported, or on two of one group.
[[nodiscard]] Codes sort_codes(const Block& block);

/// "G38.2" from 382.
[[nodiscard]] std::string shown(char letter, int tenths);

}  // namespace feedtwin::controllers::gcode
