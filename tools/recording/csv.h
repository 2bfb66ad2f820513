#pragma once
// Recordings as CSV: a header line of names, then one row of finite numbers a sample; comma between, point in them.

#include <string>
#include <string_view>

#include "tools/recording/table.h"

namespace feedtwin::tools {

/// Throws InputError with file, line and column of the first thing that is wrong.
[[nodiscard]] Table read_csv(const std::string& path);
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Table parse_csv(std::string_view text, const std::string& name);

/// Shortest digits that give every number back exactly; the file is written whole or not at all. Throws InputError.
void write_csv(const std::string& path, const std::vector<Column>& columns);

}  // namespace feedtwin::tools
