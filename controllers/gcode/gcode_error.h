#pragma once
// What is wrong with a program, and where.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace feedtwin::controllers::gcode {

class GcodeError : public std::runtime_error {
 public:
  /// @param line, column both from 1
  GcodeError(std::size_t line, std::size_t column, const std::string& problem)
      : std::runtime_error(problem), line_(line), column_(column) {}
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  [[nodiscard]] std::size_t column() const noexcept { return column_; }

 private:
  std::size_t line_, column_;
};

}  // namespace feedtwin::controllers::gcode
