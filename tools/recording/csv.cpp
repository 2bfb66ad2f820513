#include "tools/recording/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {
namespace {

constexpr std::size_t longest_shown = 24;

/// Printable beginning of a cell for a message.
std::string shown(std::string_view cell) {
  std::string text(cell.substr(0, longest_shown));
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e; }, '?');
  return text + (cell.size() > longest_shown ? "..." : "");
}

class CsvParser {
 public:
  CsvParser(std::string_view text, const std::string& name) : text_(text) {
    table_.file = name;
    table_.is_text = true;
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // a byte-order mark, as spreadsheets write it
  }

  Table parse() {
    if (text_.empty()) throw InputError(table_.file, 0, "", "is empty; expected a header line and rows of numbers");
    header(next_line());
    const std::size_t width = table_.columns.size();
    const std::size_t expected = text_.size() / (width * 6 + 1);
    for (auto& column : table_.columns) column.values.reserve(expected);
    while (!text_.empty()) {
      const std::string_view line = next_line();
      if (line.empty()) {
        if (!text_.empty()) fail(0, "is an empty line between rows");
        break;
      }
      row(line);
    }
    if (table_.columns.front().values.empty()) fail(0, "holds no rows of numbers after the header line");
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& problem) const {
    throw InputError(fmt::format("{}:{}{}: {}", table_.file, line_, column > 0 ? fmt::format(":{}", column) : "", problem));
  }

  std::string_view next_line() {
    ++line_;
    const std::size_t end = text_.find('\n');
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  void header(std::string_view line) {
    for (std::size_t column = 1;; ++column) {
      const std::size_t comma = line.find(',');
      const std::string_view name = line.substr(0, comma);
      if (name.find_first_of(";\t") != std::string_view::npos) {
        fail(column, "columns must be separated by commas, found '" + shown(name) + "'");
      }
      if (name.empty()) fail(column, "a column without a name");
      const bool printable = std::ranges::all_of(name, [](char c) { return c > 0x20 && c < 0x7f && c != '"'; });
      if (!printable) {
        fail(column, "expected a column name without spaces or quotes, found '" + shown(name) + "'");
      }
      double number{};
      if (std::from_chars(name.data(), name.data() + name.size(), number).ec == std::errc{} &&
          name.find_first_not_of("0123456789+-.eE") == std::string_view::npos) {
        fail(column, "expected a header line of column names, found the number " + shown(name));
      }
      if (table_.find(name) != nullptr) fail(column, "column '" + shown(name) + "' is there twice");
      table_.columns.push_back({std::string(name), {}});
      if (comma == std::string_view::npos) return;
      line.remove_prefix(comma + 1);
    }
  }

  /// A word of a log, as against a number gone wrong.
  static bool is_word(std::string_view cell) {
    const bool letters =
        std::ranges::all_of(cell, [](char c) { return (c >= 'a' && c <= 'z') || c == '-' || c == '_' || c == ' '; });
    return letters && cell.size() > 3 && cell != "infinity";
  }

  /// What the first row shows words in is a column of words.
  void find_words(std::string_view line) {
    for (auto& column : table_.columns) {
      const std::size_t comma = line.find(',');
      column.words = is_word(line.substr(0, comma));
      if (comma == std::string_view::npos) return;
      line.remove_prefix(comma + 1);
    }
  }

  void row(std::string_view line) {
    if (table_.columns.front().values.empty()) find_words(line);
    const char* at = line.data();
    const char* const end = at + line.size();
    const std::size_t width = table_.columns.size();
    for (std::size_t i = 0; i < width; ++i) {
      double value{};
      auto [stop, error] = std::from_chars(at, end, value);
      if (table_.columns[i].words) {
        const char* const cell_end = std::find(at, end, ',');
        if (is_word({at, cell_end})) {
          stop = cell_end;
          error = std::errc{};
        }
      }
      const bool last = i + 1 == width;
      const bool whole = error == std::errc{} && (last ? stop == end : stop != end && *stop == ',');
      if (!whole || !std::isfinite(value)) fail_row(line, i, {at, static_cast<std::size_t>(end - at)});
      table_.columns[i].values.push_back(value);
      at = last ? stop : stop + 1;
    }
  }

  [[noreturn]] void fail_row(std::string_view line, std::size_t column, std::string_view rest) const {
    const auto found = static_cast<std::size_t>(std::ranges::count(line, ',')) + 1;
    if (found != table_.columns.size()) {
      fail(0, fmt::format("expected {} columns, found {}{}", table_.columns.size(), found,
                          text_.empty() ? " (is the file cut short?)" : ""));
    }
    const std::string cell = shown(rest.substr(0, rest.find(',')));
    fail(column + 1, fmt::format("{}: expected a finite number, found '{}'", table_.columns[column].name, cell));
  }

  std::string_view text_;
  Table table_;
  std::size_t line_ = 0;
};

}  // namespace

Table parse_csv(std::string_view text, const std::string& name) {
  return CsvParser(text, name).parse();
}

Table read_csv(const std::string& path) {
  return parse_csv(read_whole_file(path), path);
}

void write_csv(const std::string& path, const std::vector<Column>& columns) {
  fmt::memory_buffer text;
  for (std::size_t i = 0; i < columns.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{}{}", i ? "," : "", columns[i].name);
  text.push_back('\n');
  for (std::size_t row = 0; row < columns.front().values.size(); ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i > 0) text.push_back(',');
      fmt::format_to(std::back_inserter(text), "{}", columns[i].values[row]);
    }
    text.push_back('\n');
  }
  write_whole_file(path, {text.data(), text.size()});
}

}  // namespace feedtwin::tools
