#pragma once
// What is wrong with something that the user gave, in one line; the program then exits with 2.

#include <stdexcept>
#include <string>

namespace feedtwin::tools {

/// "axis.toml:12: motor.inertia_kgm2: expected a number from 1e-09 to 100, found \"heavy\""
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& line) : std::runtime_error(line) {}
  /// @param line 1-based; 0 where there is none; @param key may be empty
  InputError(const std::string& file, std::size_t line, const std::string& key, const std::string& problem)
      : std::runtime_error(file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + (key.empty() ? "" : key + ": ") +
                           problem) {}
};

}  // namespace feedtwin::tools
