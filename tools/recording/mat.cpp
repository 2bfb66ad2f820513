#include "tools/recording/mat.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <matio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>

#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {
namespace {

template <class Stored>
void copy(const matvar_t& variable, std::vector<double>& values) {
  const auto* from = static_cast<const Stored*>(variable.data);
  std::copy(from, from + values.size(), values.begin());
}

bool copy_any(const matvar_t& variable, std::vector<double>& values) {
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      copy<double>(variable, values);
      return true;
    case MAT_T_SINGLE:
      copy<float>(variable, values);
      return true;
    case MAT_T_INT64:
      copy<std::int64_t>(variable, values);
      return true;
    case MAT_T_UINT64:
      copy<std::uint64_t>(variable, values);
      return true;
    case MAT_T_INT32:
      copy<std::int32_t>(variable, values);
      return true;
    case MAT_T_UINT32:
      copy<std::uint32_t>(variable, values);
      return true;
    case MAT_T_INT16:
      copy<std::int16_t>(variable, values);
      return true;
    case MAT_T_UINT16:
      copy<std::uint16_t>(variable, values);
      return true;
    case MAT_T_INT8:
      copy<std::int8_t>(variable, values);
      return true;
    case MAT_T_UINT8:
      copy<std::uint8_t>(variable, values);
      return true;
    default:
      return false;
  }
}

/// The length of a real vector; 0 for everything else.
std::size_t vector_length(const matvar_t& variable) {
  if (variable.rank != 2 || variable.isComplex != 0 || variable.dims == nullptr) return 0;
  if (variable.class_type < MAT_C_DOUBLE || variable.class_type > MAT_C_UINT64) return 0;
  const std::size_t rows = variable.dims[0], columns = variable.dims[1];
  return std::min(rows, columns) == 1 ? std::max(rows, columns) : 0;
}

void check_finite(const Table& table, std::size_t column) {
  const auto& values = table.columns[column].values;
  const auto bad = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
  if (bad == values.end()) return;
  throw InputError(fmt::format("{}: expected a finite number, found {}",
                               table.place(column, static_cast<std::size_t>(bad - values.begin())), *bad));
}

constexpr std::size_t header_bytes = 128;

std::uint32_t word_at(const std::string& bytes, std::size_t at, bool swapped) {
  std::uint32_t word{};
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return swapped ? __builtin_bswap32(word) : word;
}

/// libmatio gives zeros for what a v5 file has lost at its end: its elements (tag of type and length, then data) must fill
/// the file exactly. v7.3 is HDF5, which knows its own end.
void check_whole(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  const bool v5 = bytes.starts_with("MATLAB 5.0");
  if (bytes.size() <= header_bytes || (!v5 && !bytes.starts_with("MATLAB 7.3"))) {
    throw InputError(path, 0, "", "is not a MATLAB file (v5 or v7.3)");
  }
  if (!v5) return;
  const bool swapped = bytes.compare(126, 2, "IM") != 0;
  std::size_t at = header_bytes;
  while (at + 8 <= bytes.size()) at += 8 + word_at(bytes, at + 4, swapped);
  if (at != bytes.size()) throw InputError(path, 0, "", "is damaged (is the file cut short?)");
}

}  // namespace

Table read_mat(const std::string& path) {
  // libmatio and HDF5 print their complaints; ours is the one line that counts
  Mat_LogInitFunc("feedtwin", [](int, char*) {});
  H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
  check_whole(path);
  const std::unique_ptr<mat_t, int (*)(mat_t*)> file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (file == nullptr) throw InputError(path, 0, "", "is damaged (is the file cut short?)");
  Table table;
  table.file = path;
  std::size_t longest = 0;
  while (true) {
    const std::unique_ptr<matvar_t, void (*)(matvar_t*)> variable(Mat_VarReadNext(file.get()), Mat_VarFree);
    if (variable == nullptr) break;
    const std::size_t length = vector_length(*variable);
    if (length < 2 || variable->name == nullptr) continue;
    if (variable->data == nullptr) throw InputError(path, 0, variable->name, "cannot be read (is the file cut short?)");
    Column column{variable->name, std::vector<double>(length)};
    if (length * Mat_SizeOf(variable->data_type) > variable->nbytes || !copy_any(*variable, column.values)) {
      throw InputError(path, 0, variable->name, "cannot be read (is the file cut short?)");
    }
    longest = std::max(longest, length);
    table.columns.push_back(std::move(column));
  }
  std::erase_if(table.columns, [longest](const Column& column) { return column.values.size() != longest; });
  if (table.columns.empty()) throw InputError(path, 0, "", "holds no vector of numbers (is the file cut short?)");
  for (std::size_t i = 0; i < table.columns.size(); ++i) check_finite(table, i);
  return table;
}

}  // namespace feedtwin::tools
