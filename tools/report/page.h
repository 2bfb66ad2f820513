#pragma once
// One self-contained HTML page from the JSON of any verb: figures that people can zoom, numbers in tables; light and dark.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace feedtwin::tools {

/// @param json what a verb wrote with --json; "figures" (figure.h) are drawn, everything else is listed
/// @param title the page's, as plain text
[[nodiscard]] std::string report_page(const nlohmann::json& json, const std::string& title);

/// A page of one's own: HTML above the figures and below them.
[[nodiscard]] std::string page_with_figures(const std::string& title, const std::string& above,
                                            const nlohmann::json& figures, const std::string& below);
/// Text made safe to stand in HTML.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace feedtwin::tools
