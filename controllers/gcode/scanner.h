#pragma once
// One line of a program, character by character: blanks mean nothing, letters have no case, columns are kept.

#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

#include "controllers/gcode/gcode_error.h"

namespace feedtwin::controllers::gcode {

class Scanner {
 public:
  Scanner(std::string_view text, std::size_t line) noexcept : text_(text), line_(line) {}

  /// The next character in lower case, blanks skipped; 0 at the end of the line.
  [[nodiscard]] char peek() noexcept {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) ++at_;
    return at_ < text_.size() ? static_cast<char>(std::tolower(static_cast<unsigned char>(text_[at_]))) : '\0';
  }
  char take() noexcept {
    const char c = peek();
    if (at_ < text_.size()) ++at_;
    return c;
  }
  bool take_if(char wanted) noexcept {
    if (peek() != wanted || at_ >= text_.size()) return false;
    ++at_;
    return true;
  }
  [[nodiscard]] bool at_end() noexcept { return peek() == '\0' && at_ >= text_.size(); }
  /// Everything up to a closing character, which is taken too, as it is written; throws when it is missing.
  std::string_view take_until(char closing, const std::string& what) {
    const std::size_t from = at_;
    const std::size_t end = text_.find(closing, from);
    if (end == std::string_view::npos) fail(from, what + " is not closed");
    at_ = end + 1;
    return text_.substr(from, end - from);
  }
  void skip_rest() noexcept { at_ = text_.size(); }

  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }
  /// @param at where, as at() gave it
  [[noreturn]] void fail(std::size_t at, const std::string& problem) const { throw GcodeError(line_, at + 1, problem); }
  [[noreturn]] void fail(const std::string& problem) const { fail(at_, problem); }

 private:
  std::string_view text_;
  std::size_t line_;
  std::size_t at_ = 0;
};

}  // namespace feedtwin::controllers::gcode
