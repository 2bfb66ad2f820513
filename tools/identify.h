#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace feedtwin::tools {

[[nodiscard]] std::function<int()> prepare_identify(CLI::App& app);

}  // namespace feedtwin::tools
