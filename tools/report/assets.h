#pragma once
// The style and the script of a report page.

#include <string_view>

namespace feedtwin::tools {

extern const std::string_view report_style;
extern const std::string_view report_script;

}  // namespace feedtwin::tools
