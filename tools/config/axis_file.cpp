#include "tools/config/axis_file.h"

#include <fmt/format.h>

#include "plant/parameter_table.h"
#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {
namespace {

void check_breakaway(const TomlFile& file, const std::string& table, const plant::LugreParameters& friction) {
  const auto check = [&](const char* direction, double coulomb_N, double static_N) {
    if (static_N >= coulomb_N) return;
    file.fail(table + ".static_" + direction + "_N",
              fmt::format("breakaway friction {:g} N is below the Coulomb friction {:g} N", static_N, coulomb_N));
  };
  check("pos", friction.coulomb_N.pos, friction.static_N.pos);
  check("neg", friction.coulomb_N.neg, friction.static_N.neg);
}

}  // namespace

plant::AxisParameters axis_from(TomlFile& file) {
  plant::AxisParameters parameters;
  for (const auto& entry : plant::parameter_table()) {
    entry.in(parameters) = entry.preset ? file.number(entry.key, entry.lowest, entry.highest, *entry.preset)
                                        : file.required_number(entry.key, entry.lowest, entry.highest);
  }
  check_breakaway(file, "ball_screw", parameters.ball_screw);
  check_breakaway(file, "guide", parameters.guide);
  return parameters;
}

plant::AxisParameters read_axis_file(const std::string& path) {
  TomlFile file = TomlFile::read(path);
  const auto parameters = axis_from(file);
  file.reject_unknown();
  return parameters;
}

void write_axis_file(const std::string& path, plant::AxisParameters parameters) {
  std::string text = "# Axis parameters, SI units. _pos and _neg: direction of motion.\n";
  std::string_view table;
  for (const auto& entry : plant::parameter_table()) {
    const auto dot = entry.key.find('.');
    if (entry.key.substr(0, dot) != table) {
      table = entry.key.substr(0, dot);
      text += fmt::format("\n[{}]\n", table);
    }
    text += fmt::format("{} = {:.17g}  # {}\n", entry.key.substr(dot + 1), entry.in(parameters), entry.meaning);
  }
  write_whole_file(path, text);
}

}  // namespace feedtwin::tools
