#pragma once
// Columns of numbers as a file gives them, under the file's own names: what CSV and MATLAB files have in common.

#include <string>
#include <string_view>
#include <vector>

namespace feedtwin::tools {

struct Column {
  std::string name;
  std::vector<double> values;
  bool words = false;  ///< holds words (a log's drive_state): no numbers to learn from, the values are all 0
};

struct Table {
  std::string file;
  bool is_text = false;  ///< row i stands in line i + 2 of the file
  std::vector<Column> columns;

  [[nodiscard]] const Column* find(std::string_view name) const noexcept;
  /// "run.csv:17:3" for a text file, "run.mat: qm(16)" otherwise.
  [[nodiscard]] std::string place(std::size_t column, std::size_t row) const;
};

/// A file by its ending: .csv or .mat. Throws InputError.
[[nodiscard]] Table read_table(const std::string& path);

}  // namespace feedtwin::tools
