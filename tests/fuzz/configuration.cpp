// Any text as an axis file or server configuration: accepted with every number in its range, or one line of complaint.

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "plant/parameter_table.h"
#include "tools/config/axis_file.h"
#include "tools/config/input_error.h"
#include "tools/config/toml_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace feedtwin;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    auto file = tools::TomlFile::parse(text, "fuzzed.toml");
    auto axis = tools::axis_from(file);
    file.reject_unknown();
    for (const auto& entry : plant::parameter_table()) {
      const double value = entry.in(axis);
      if (!(value >= entry.lowest && value <= entry.highest)) std::abort();
    }
  } catch (const tools::InputError& error) {
    if (std::strlen(error.what()) == 0) std::abort();
  }
  return 0;
}
