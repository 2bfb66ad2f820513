// Any bytes as a CSV recording: a table of equal columns of finite numbers, or one line of complaint.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "tools/config/input_error.h"
#include "tools/recording/csv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace feedtwin;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto table = tools::parse_csv(text, "fuzzed.csv");
    for (const auto& column : table.columns) {
      if (column.values.size() != table.columns.front().values.size()) std::abort();
      for (const double value : column.values) {
        if (!std::isfinite(value)) std::abort();
      }
    }
  } catch (const tools::InputError& error) {
    if (std::strlen(error.what()) == 0) std::abort();
  }
  return 0;
}
