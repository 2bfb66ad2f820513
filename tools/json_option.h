#pragma once
// --json FILE, on every verb that reports numbers.

#include <CLI/App.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace feedtwin::tools {

void add_json_option(CLI::App& app, std::string& path);
/// Writes the file whole; nothing when `path` is empty. Throws InputError.
void write_json(const std::string& path, const nlohmann::json& value);

}  // namespace feedtwin::tools
