#pragma once
// A CSV file that grows by whole rows: whatever ends the program, what was written stays readable.

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace feedtwin::tools {

class CsvFile {
 public:
  /// Creates the file with its header line; throws InputError.
  CsvFile(std::string path, std::string_view header);
  ~CsvFile();
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  /// Append one whole row, without its line end.
  void add(std::string_view row);
  /// Hand whole rows to the kernel; rows that it does not take (disk full) are counted.
  void flush() noexcept;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::uint64_t unwritten_rows() const noexcept { return unwritten_rows_; }

 private:
  std::string path_;
  int fd_ = -1;
  fmt::memory_buffer pending_;
  std::uint64_t pending_rows_ = 0, unwritten_rows_ = 0;
};

}  // namespace feedtwin::tools
