#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace feedtwin::tools {

[[nodiscard]] std::function<int()> prepare_can_files(CLI::App& app);

}  // namespace feedtwin::tools
