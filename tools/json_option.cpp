#include "tools/json_option.h"

#include <nlohmann/json.hpp>

#include "tools/config/whole_file.h"

namespace feedtwin::tools {

void add_json_option(CLI::App& app, std::string& path) {
  app.add_option("--json", path, "write the results as JSON to this file")->type_name("FILE");
}

void write_json(const std::string& path, const nlohmann::json& value) {
  if (!path.empty()) write_whole_file(path, value.dump(2) + "\n");
}

}  // namespace feedtwin::tools
