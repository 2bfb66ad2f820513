#pragma once
// A file is written whole or not at all.

#include <string>
#include <string_view>

namespace feedtwin::tools {

/// Writes beside the file, then renames; throws InputError and leaves nothing when that can't be done.
void write_whole_file(const std::string& path, std::string_view text);

/// The text of a file; throws InputError.
[[nodiscard]] std::string read_whole_file(const std::string& path);

}  // namespace feedtwin::tools
