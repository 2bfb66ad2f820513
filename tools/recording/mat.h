#pragma once
// Recordings as MATLAB files, v5 and v7.3, through libmatio.

#include <string>

#include "tools/recording/table.h"

namespace feedtwin::tools {

/// Every real vector of the file that is as long as the longest one; scalars and other shapes are left out.
/// Throws InputError: unreadable file, no vector, a value that is not finite.
[[nodiscard]] Table read_mat(const std::string& path);

}  // namespace feedtwin::tools
