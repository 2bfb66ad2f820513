#pragma once
// One recorded run of an axis: channels in SI units, one row a sample, under the names that a recording's columns have.

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/recording/table.h"

namespace feedtwin::tools {

/// A channel that a recording may hold.
struct ChannelKind {
  std::string_view name;  ///< quantity_unit
  std::string_view unit, meaning;
};

namespace channel {
inline constexpr std::string_view time_s = "time_s";
inline constexpr std::string_view torque_cmd_Nm = "torque_cmd_Nm";
inline constexpr std::string_view force_cmd_N = "force_cmd_N";
inline constexpr std::string_view position_m = "position_m";
inline constexpr std::string_view scale_position_m = "scale_position_m";
inline constexpr std::string_view torque_sensor_Nm = "torque_sensor_Nm";
inline constexpr std::string_view force_sensor_N = "force_sensor_N";
inline constexpr std::string_view power_W = "power_W";
inline constexpr std::string_view reference_m = "reference_m";
inline constexpr std::string_view temperature_C = "temperature_C";
}  // namespace channel

[[nodiscard]] std::span<const ChannelKind> channel_kinds() noexcept;

/// Where a channel comes from when the file has names or units of its own: value = scale * column + offset.
struct ChannelSource {
  std::string column;
  double scale = 1.0;
  double offset = 0.0;
};
using ChannelMap = std::map<std::string, ChannelSource, std::less<>>;

/// What a reading of the power meter is the mean of.
struct MeterHabit {
  std::size_t delay = 0;           ///< ticks between the window's last and the reading's row: 0 or 1
  bool instants = true;            ///< of the power at the rows' instants; otherwise over all time between them
  double readings_a_window = 1.0;  ///< windows overlap where it is more, and do not meet where it is less
  bool of_command = false;         ///< computed from the commanded torque and not measured
  bool errors_alike = false;       ///< its readings err by as much however large they are; otherwise in proportion
};

struct Recording {
  std::string file;
  std::map<std::string, std::vector<double>, std::less<>> channels;  ///< all equally long
  std::vector<std::string> unused_columns;                           ///< of the file
  double sample_s = 0.0;                                             ///< between rows
  MeterHabit meter;                                                  ///< of the power meter (power_meter.h)
  bool forces_before_command = false;  ///< torque and force sensor are read before the row's command sets in

  [[nodiscard]] std::size_t size() const noexcept;
  [[nodiscard]] double duration_s() const noexcept { return static_cast<double>(size()) * sample_s; }
  [[nodiscard]] bool has(std::string_view name) const noexcept { return channels.contains(name); }
  /// The values of a channel; empty where the recording lacks it.
  [[nodiscard]] std::span<const double> at(std::string_view name) const noexcept;
  /// Where a value stands in the file, for messages.
  [[nodiscard]] std::string place(std::string_view name, std::size_t row) const;

  bool is_text = false;
  std::map<std::string, std::pair<std::string, std::size_t>, std::less<>> columns;  ///< channel -> name, index in the file
};

/// Channels by their own names and by the map. Throws InputError: a mapped column or a channel that must be there is
/// missing. Must be there: time, one command (torque or force), the motor's position or the scale's.
[[nodiscard]] Recording recording_from(Table table, const ChannelMap& map);

/// Every channel that the recording holds, in the order of channel_kinds(). Throws InputError.
void write_recording(const std::string& path, const Recording& recording);

}  // namespace feedtwin::tools
