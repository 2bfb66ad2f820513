#include "tools/config/axis_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "plant/effects/registry.h"
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

plant::EffectSetting effect_at(TomlFile& file, const std::string& table, const plant::EffectEntry& entry) {
  plant::EffectSetting setting{.id = std::string(entry.id), .values = {}, .lists = {}};
  for (const auto& parameter : entry.parameters) {
    const std::string key = fmt::format("{}.{}", table, parameter.name);
    if (parameter.list) {
      setting.lists.push_back(file.numbers(key, parameter.lowest, parameter.highest));
    } else if (parameter.preset) {
      setting.values.push_back(file.number(key, parameter.lowest, parameter.highest, *parameter.preset));
    } else {
      setting.values.push_back(file.required_number(key, parameter.lowest, parameter.highest));
    }
  }
  for (const auto& name : file.names_in(table)) {
    if (std::ranges::find(entry.parameters, name, &plant::EffectParameter::name) == entry.parameters.end()) {
      file.fail(fmt::format("{}.{}", table, name), fmt::format("{} has no such parameter", entry.id));
    }
  }
  const std::string problem = entry.problem != nullptr ? entry.problem(setting) : "";
  if (!problem.empty()) file.fail(table, problem);
  return setting;
}

/// [effects.cogging] once, [[effects.cogging]] as often as there are several.
std::vector<plant::EffectSetting> effects_from(TomlFile& file) {
  std::vector<plant::EffectSetting> effects;
  for (const auto& id : file.names_in("effects")) {
    const std::string table = fmt::format("effects.{}", id);
    const auto* entry = plant::find_effect(id);
    if (entry == nullptr) file.fail(table, "unknown effect");
    if (!file.has(table + "[0]")) {
      effects.push_back(effect_at(file, table, *entry));
      continue;
    }
    for (std::size_t i = 0; i < file.tables_in(table); ++i) {
      effects.push_back(effect_at(file, fmt::format("{}[{}]", table, i), *entry));
    }
  }
  return effects;
}

std::string text_of(const plant::EffectSetting& setting, bool several) {
  const auto* entry = plant::find_effect(setting.id);
  if (entry == nullptr) throw std::invalid_argument("no effect has the id " + setting.id);
  std::string text = fmt::format("\n# {}: {}\n", plant::name_of(entry->component), entry->meaning);
  text += several ? fmt::format("[[effects.{}]]\n", setting.id) : fmt::format("[effects.{}]\n", setting.id);
  auto value = setting.values.begin();
  auto list = setting.lists.begin();
  for (const auto& parameter : entry->parameters) {
    if (!parameter.list) {
      text += fmt::format("{} = {}  # {}\n", parameter.name, *value++, parameter.meaning);
    } else if (const auto& numbers = *list++; !numbers.empty()) {
      text += fmt::format("{} = [", parameter.name);
      for (const double number : numbers) text += fmt::format("{}, ", number);
      text += fmt::format("]  # {}\n", parameter.meaning);
    }
  }
  return text;
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
  parameters.effects = effects_from(file);
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
    text += fmt::format("{} = {}  # {}\n", entry.key.substr(dot + 1), entry.in(parameters), entry.meaning);
  }
  for (const auto& setting : parameters.effects) {
    text += text_of(setting, std::ranges::count(parameters.effects, setting.id, &plant::EffectSetting::id) > 1);
  }
  write_whole_file(path, text);
}

}  // namespace feedtwin::tools
