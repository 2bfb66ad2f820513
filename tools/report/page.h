#pragma once
// One self-contained HTML page from the JSON of any verb: figures that people can zoom, numbers in tables; light and dark.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace feedtwin::tools {

/// @param json what a verb wrote with --json; "figures" (figure.h) are drawn, everything else is listed
/// @param title the page's, as plain text
[[nodiscard]] std::string report_page(const nlohmann::json& json, const std::string& title);

}  // namespace feedtwin::tools
