#include "tools/config/fault_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace feedtwin::tools {
namespace {

using io::faults::FaultKind;

constexpr double longest_s = 1e9;

io::faults::Fault fault_of(TomlFile& file, const std::string& table, int axes) {
  const auto at = [&table](const char* key) { return table + "." + key; };
  std::vector<std::string> names;
  for (const auto& kind : io::faults::kind_names) names.emplace_back(kind.name);
  const auto name = file.word(at("kind"), names, "");
  if (name.empty()) file.fail(table, fmt::format("kind is missing; expected one of {}", fmt::join(names, ", ")));
  io::faults::Fault fault;
  fault.kind = std::ranges::find(io::faults::kind_names, name, &io::faults::KindName::name)->kind;
  fault.at_s = file.required_number(at("at_s"), 0.0, longest_s);
  fault.axis = static_cast<int>(file.integer(at("axis"), -1, axes - 1, -1));
  if (fault.kind == FaultKind::lost_counts) {
    fault.counts = file.integer(at("counts"), -1'000'000'000, 1'000'000'000, 1);
    return fault;
  }
  fault.for_s = file.number(at("for_s"), 1e-6, longest_s, longest_s);
  if (!io::faults::named(fault.kind).encoder) fault.share = file.number(at("share"), 0.0, 1.0, 1.0);
  if (fault.kind == FaultKind::late_command) fault.delay_s = file.required_number(at("delay_s"), 1e-6, 1.0);
  return fault;
}

}  // namespace

std::vector<ConfiguredFault> faults_from(TomlFile& file, const std::vector<std::string>& ports,
                                         const std::string& controller, int axes) {
  std::vector<ConfiguredFault> faults;
  const std::size_t count = file.tables_in("fault");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string table = fmt::format("fault[{}]", i);
    ConfiguredFault configured{fault_of(file, table, axes), ""};
    const bool of_commands = !io::faults::named(configured.fault.kind).encoder;
    configured.port = file.word(table + ".port", ports, of_commands ? controller : "");
    faults.push_back(std::move(configured));
  }
  return faults;
}

std::vector<io::faults::Fault> faults_of(const std::vector<ConfiguredFault>& faults, std::string_view port) {
  std::vector<io::faults::Fault> own;
  for (const auto& configured : faults) {
    if (configured.port.empty() || configured.port == port) own.push_back(configured.fault);
  }
  return own;
}

}  // namespace feedtwin::tools
