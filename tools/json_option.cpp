#include "tools/json_option.h"

#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/config/whole_file.h"

namespace feedtwin::tools {

void add_json_option(CLI::App& app, std::string& path) {
  app.add_option("--json", path, "write the results as JSON to this file")
      ->type_name("FILE")
      ->check([](const std::string& file) {
        // said now rather than after a long run
        const auto folder = std::filesystem::absolute(file).parent_path();
        return ::access(folder.c_str(), W_OK) == 0 ? std::string() : file + ": its folder can't be written";
      });
}

void write_json(const std::string& path, const nlohmann::json& value) {
  if (!path.empty()) write_whole_file(path, value.dump(2) + "\n");
}

}  // namespace feedtwin::tools
