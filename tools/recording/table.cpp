#include "tools/recording/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tools/config/input_error.h"
#include "tools/recording/csv.h"
#include "tools/recording/mat.h"

namespace feedtwin::tools {

const Column* Table::find(std::string_view name) const noexcept {
  const auto found = std::ranges::find(columns, name, &Column::name);
  return found == columns.end() ? nullptr : &*found;
}

std::string Table::place(std::size_t column, std::size_t row) const {
  return is_text ? fmt::format("{}:{}:{}", file, row + 2, column + 1)
                 : fmt::format("{}: {}({})", file, columns[column].name, row + 1);
}

Table read_table(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".csv") return read_csv(path);
  if (ending == ".mat") return read_mat(path);
  throw InputError(path, 0, "", "expected a recording that ends in .csv or .mat");
}

}  // namespace feedtwin::tools
