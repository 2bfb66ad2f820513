#pragma once
// The reproduction as a self-contained HTML page.

#include <string>

#include "tools/machine/reproduction.h"

namespace feedtwin::tools {

[[nodiscard]] std::string reproduction_page(const Reproduction& reproduction);

}  // namespace feedtwin::tools
