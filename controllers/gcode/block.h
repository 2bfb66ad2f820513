#pragma once
// One line of a program taken apart: words, settings of parameters, with the columns that errors point at.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/gcode/expression.h"
#include "controllers/gcode/parameters.h"

namespace feedtwin::controllers::gcode {

struct Word {
  double value = 0.0;
  std::size_t at = 0;  ///< offset in the line
};

/// A G or M word: its number times ten, so that G61.1 is 611.
struct Code {
  int tenths = 0;
  std::size_t at = 0;
};

struct Block {
  std::size_t line = 0;
  bool deleted = false;  ///< starts with '/'
  std::vector<Code> g, m;
  std::array<std::optional<Word>, 26> words;  ///< by letter, G, M and N apart
  struct Setting {
    ParameterName name;
    double value;
    std::size_t at;
  };
  std::vector<Setting> settings;  ///< take effect after the line has been read

  [[nodiscard]] const std::optional<Word>& word(char letter) const noexcept {
    return words[static_cast<std::size_t>(letter - 'a')];
  }
  [[noreturn]] void fail(std::size_t at, const std::string& problem) const { throw GcodeError(line, at + 1, problem); }
};

/// Throws GcodeError. @param line from 1
[[nodiscard]] Block read_block(std::string_view text, std::size_t line, const Parameters& parameters);

}  // namespace feedtwin::controllers::gcode
