#pragma once
// A verb of the command line: one file that makes one of these, and one line in verbs.cpp.

#include <CLI/App.hpp>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace feedtwin::tools {

/// How the program ends.
enum ExitCode : int { done = 0, not_so = 1, wrong_input = 2 };

struct Verb {
  std::string_view name, meaning;
  /// Adds the verb's options and returns what runs it. An InputError thrown from there ends the program with 2.
  std::function<int()> (*prepare)(CLI::App& app);
};

[[nodiscard]] std::span<const Verb> verbs() noexcept;

}  // namespace feedtwin::tools
