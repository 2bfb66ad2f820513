#include "controllers/gcode/block.h"

#include <cmath>

namespace feedtwin::controllers::gcode {
namespace {

constexpr std::string_view letters_in_use = "fijkpqrstxyz";
constexpr std::size_t most_m_words = 4;

void skip_comment(Scanner& in, std::size_t from) {
  if (in.take_until(')', "the comment").find('(') != std::string_view::npos) {
    in.fail(from, "a comment within a comment");
  }
}

/// Codes have at most one decimal.
Code read_code(Scanner& in, char letter, std::size_t from, const Parameters& parameters) {
  const double tenths = 10.0 * read_value(in, parameters);
  const double whole = std::round(tenths);
  if (whole < 0.0 || whole > 9999.0 || std::abs(tenths - whole) > 1e-3) {
    in.fail(from, std::string("expected a code number after ") + static_cast<char>(letter - 'a' + 'A'));
  }
  return {static_cast<int>(whole), from};
}

void read_setting(Scanner& in, Block& block, std::size_t from, const Parameters& parameters) {
  ParameterName name = read_parameter_name(in, parameters);
  if (!in.take_if('=')) in.fail("expected '=' after the parameter");
  const double value = read_value(in, parameters);
  block.settings.push_back({std::move(name), value, from});
}

void read_word(Scanner& in, Block& block, const Parameters& parameters) {
  const std::size_t from = in.at();
  const char letter = in.take();
  if (letter == 'g') {
    block.g.push_back(read_code(in, letter, from, parameters));
  } else if (letter == 'm') {
    block.m.push_back(read_code(in, letter, from, parameters));
    if (block.m.size() > most_m_words) in.fail(from, "more than four M words on a line");
  } else if (letters_in_use.find(letter) != std::string_view::npos) {
    auto& word = block.words[static_cast<std::size_t>(letter - 'a')];
    if (word) in.fail(from, std::string("a second ") + static_cast<char>(letter - 'a' + 'A') + " word on the line");
    word = Word{read_value(in, parameters), from};
  } else if (letter >= 'a' && letter <= 'z') {
    in.fail(from, std::string("the letter ") + static_cast<char>(letter - 'a' + 'A') + " is not supported");
  } else {
    in.fail(from, std::string("unexpected character '") + letter + "'");
  }
}

}  // namespace

Block read_block(std::string_view text, std::size_t line, const Parameters& parameters) {
  Scanner in(text, line);
  Block block;
  block.line = line;
  block.deleted = in.take_if('/');
  if (in.take_if('n')) {
    const std::size_t from = in.at();
    const double number = read_value(in, parameters);
    if (number < 0.0) in.fail(from, "expected a line number after N");
  }
  while (!in.at_end()) {  // which skips blanks too
    const std::size_t from = in.at();
    if (in.take_if('(')) {
      skip_comment(in, from);
    } else if (in.take_if(';')) {
      in.skip_rest();
    } else if (in.take_if('#')) {
      read_setting(in, block, from, parameters);
    } else {
      read_word(in, block, parameters);
    }
  }
  return block;
}

}  // namespace feedtwin::controllers::gcode
