#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace feedtwin::tools {

[[nodiscard]] std::function<int()> prepare_check(CLI::App& app);

}  // namespace feedtwin::tools
