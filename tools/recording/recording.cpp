#include "tools/recording/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "tools/config/input_error.h"
#include "tools/recording/csv.h"

namespace feedtwin::tools {
namespace {

constexpr std::array kinds{
    ChannelKind{channel::time_s, "s", "time of the sample"},
    ChannelKind{channel::torque_cmd_Nm, "N m", "torque command, held until the next sample"},
    ChannelKind{channel::force_cmd_N, "N", "force command at the table, held until the next sample"},
    ChannelKind{channel::position_m, "m", "motor encoder as table travel"},
    ChannelKind{channel::scale_position_m, "m", "linear scale at the table"},
    ChannelKind{channel::torque_sensor_Nm, "N m", "torque between motor and screw"},
    ChannelKind{channel::force_sensor_N, "N", "force between nut and table"},
    ChannelKind{channel::power_W, "W", "drive input power"},
    ChannelKind{channel::reference_m, "m", "position that the controller was asked for"},
    ChannelKind{channel::temperature_C, "C", "temperature"},
};

void require_channels(const Recording& recording) {
  const auto missing = [&](std::string_view what) {
    std::vector<std::string> found;
    for (const auto& [name, where] : recording.columns) found.push_back(name);
    throw InputError(
        recording.file, 0, "",
        fmt::format("no {} channel; found {}{}", what, found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", ")),
                    recording.unused_columns.empty() ? ""
                                                     : fmt::format(" and the unknown {} (map them in case.toml [channels])",
                                                                   fmt::join(recording.unused_columns, ", "))));
  };
  if (!recording.has(channel::time_s)) missing("time_s");
  if (!recording.has(channel::torque_cmd_Nm) && !recording.has(channel::force_cmd_N))
    missing("torque_cmd_Nm or force_cmd_N");
  if (!recording.has(channel::position_m) && !recording.has(channel::scale_position_m))
    missing("position_m or scale_position_m");
}

}  // namespace

std::span<const ChannelKind> channel_kinds() noexcept {
  return kinds;
}

std::size_t Recording::size() const noexcept {
  return channels.empty() ? 0 : channels.begin()->second.size();
}

std::span<const double> Recording::at(std::string_view name) const noexcept {
  const auto found = channels.find(name);
  return found == channels.end() ? std::span<const double>{} : std::span<const double>(found->second);
}

std::string Recording::place(std::string_view name, std::size_t row) const {
  const auto found = columns.find(name);
  if (found == columns.end()) return fmt::format("{}: {}, sample {}", file, name, row + 1);
  const auto& [column, index] = found->second;
  return is_text ? fmt::format("{}:{}:{}: {}", file, row + 2, index + 1, column)
                 : fmt::format("{}: {}({})", file, column, row + 1);
}

Recording recording_from(Table table, const ChannelMap& map) {
  Recording recording;
  recording.file = table.file;
  recording.is_text = table.is_text;
  std::set<std::string, std::less<>> used;
  const auto take = [&](std::string_view channel_name, const ChannelSource& source) {
    const Column* column = table.find(source.column);
    if (column == nullptr) return false;
    if (column->words) throw InputError(table.file, 2, source.column, "expected numbers, found words");
    auto& values = recording.channels[std::string(channel_name)];
    values.resize(column->values.size());
    std::ranges::transform(column->values, values.begin(),
                           [&source](double value) { return source.scale * value + source.offset; });
    recording.columns[std::string(channel_name)] = {source.column, static_cast<std::size_t>(column - table.columns.data())};
    used.insert(source.column);
    return true;
  };
  for (const auto& [name, source] : map) {
    if (take(name, source)) continue;
    std::vector<std::string> found;
    for (const auto& column : table.columns) found.push_back(column.name);
    throw InputError(table.file, 0, name, fmt::format("no column '{}'; found {}", source.column, fmt::join(found, ", ")));
  }
  for (const auto& kind : kinds) {
    if (!map.contains(kind.name)) take(kind.name, {std::string(kind.name)});
  }
  for (const auto& column : table.columns) {
    if (!used.contains(column.name)) recording.unused_columns.push_back(column.name);
  }
  require_channels(recording);
  const auto time = recording.at(channel::time_s);
  if (time.size() > 1) recording.sample_s = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  return recording;
}

void write_recording(const std::string& path, const Recording& recording) {
  std::vector<Column> columns;
  for (const auto& kind : kinds) {
    const auto values = recording.at(kind.name);
    if (!values.empty()) columns.push_back({std::string(kind.name), {values.begin(), values.end()}});
  }
  write_csv(path, columns);
}

}  // namespace feedtwin::tools
