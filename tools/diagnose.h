#pragma once
// feedtwin diagnose CASE: where recording and model differ, what physics is missing, how well it is known.

#include <CLI/App.hpp>
#include <functional>

namespace feedtwin::tools {

std::function<int()> prepare_diagnose(CLI::App& app);

}  // namespace feedtwin::tools
