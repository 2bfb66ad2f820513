#include "tools/recording/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numbers>

#include "tools/config/axis_file.h"
#include "tools/config/input_error.h"
#include "tools/config/toml_file.h"
#include "tools/recording/checks.h"
#include "tools/recording/power_meter.h"
#include "tools/recording/repeated_readings.h"

namespace feedtwin::tools {
namespace {

constexpr double largest_scale = 1e12;

ChannelMap channel_map(TomlFile& file) {
  ChannelMap map;
  for (const auto& name : file.names_in("channels")) {
    const std::string key = "channels." + name;
    if (std::ranges::find(channel_kinds(), name, &ChannelKind::name) == channel_kinds().end()) {
      std::vector<std::string_view> known;
      for (const auto& kind : channel_kinds()) known.push_back(kind.name);
      file.fail(key, fmt::format("unknown channel; expected one of {}", fmt::join(known, ", ")));
    }
    const auto column = file.text(key + ".column");
    if (!column) file.fail(key, "expected { column = \"name in the file\", scale = 1.0 }");
    const double scale = file.number(key + ".scale", -largest_scale, largest_scale, 1.0);
    if (scale == 0.0) file.fail(key + ".scale", "expected a number other than 0");
    map[name] = {*column, scale, file.number(key + ".offset", -largest_scale, largest_scale, 0.0)};
  }
  return map;
}

/// What of [controller] is not of a cascade as feedtwin runs it at the recordings' rate; empty: nothing.
std::string foreign_to_cascade(TomlFile& file, double sample_rate_Hz) {
  constexpr std::array own{"type",
                           "sample_rate_Hz",
                           "position_per_s",
                           "velocity_Ns_per_m",
                           "velocity_integral_N_per_m",
                           "velocity_feedforward",
                           "acceleration_feedforward_kg",
                           "current_loop_time_constant_s",
                           "velocity_window_samples",
                           "torque_limit_Nm"};
  if (const auto type = file.text("controller.type", "cascade"); type != "cascade")
    return fmt::format("the type '{}'", type);
  if (file.number("controller.sample_rate_Hz", 1.0, 1e6, sample_rate_Hz) != sample_rate_Hz) return "another sample rate";
  for (const auto& name : file.names_in("controller"))
    if (std::ranges::find(own, name) == own.end()) return fmt::format("the key '{}'", name);
  return "";
}

/// None where the case names none, or one whose law is not known here: a stand-in takes its place.
std::optional<controllers::CascadeGains> controller(TomlFile& file, Case& into) {
  if (file.names_in("controller").empty()) return std::nullopt;
  if (const auto foreign = foreign_to_cascade(file, into.sample_rate_Hz); !foreign.empty()) {
    file.leave("controller");
    into.remarks.push_back(
        fmt::format("{}: [controller] has {}, which is none of feedtwin's cascade: in closed loop a stand-in "
                    "that tracks the recorded motion takes its place",
                    file.path(), foreign));
    return std::nullopt;
  }
  controllers::CascadeGains gains;
  gains.position_per_s = file.required_number("controller.position_per_s", 0.0, 1e6);
  gains.velocity_Ns_per_m = file.required_number("controller.velocity_Ns_per_m", 0.0, 1e9);
  gains.velocity_integral_N_per_m = file.number("controller.velocity_integral_N_per_m", 0.0, 1e12, 0.0);
  gains.velocity_feedforward = file.number("controller.velocity_feedforward", -10.0, 10.0, 0.0);
  gains.acceleration_feedforward_kg = file.number("controller.acceleration_feedforward_kg", 0.0, 1e6, 0.0);
  gains.current_loop_time_constant_s = file.number("controller.current_loop_time_constant_s", 0.0, 1.0, 0.0);
  gains.velocity_window_samples = static_cast<int>(file.integer("controller.velocity_window_samples", 1, 4, 1));
  gains.torque_limit_Nm = file.number("controller.torque_limit_Nm", 1e-6, 1e6, into.axis.axis.torque_limit_Nm);
  gains.lead_m = into.axis.axis.lead_m;
  return gains;
}

/// Torque from force, motor position from the scale, where those are all that was recorded.
void complete(Recording& recording, const plant::AxisParameters& axis, std::vector<std::string>& remarks) {
  if (!recording.has(channel::torque_cmd_Nm)) {
    auto torque = recording.channels.at(std::string(channel::force_cmd_N));
    for (double& value : torque) value *= axis.axis.lead_m / (2.0 * std::numbers::pi);
    recording.channels[std::string(channel::torque_cmd_Nm)] = std::move(torque);
  } else if (recording.has(channel::force_cmd_N)) {
    remarks.push_back(recording.file + ": both torque_cmd_Nm and force_cmd_N; the torque is used");
  }
  if (!recording.has(channel::position_m)) {
    recording.channels[std::string(channel::position_m)] = recording.channels.at(std::string(channel::scale_position_m));
    remarks.push_back(recording.file + ": no motor encoder; the scale stands for it");
  }
}

std::vector<Recording> recordings(TomlFile& file, const char* key, const ChannelMap& map, Case& into) {
  std::vector<Recording> all;
  for (const auto& name : file.texts(key)) {
    Recording recording = recording_from(read_table((std::filesystem::path(into.folder) / name).string()), map);
    complete(recording, into.axis, into.remarks);
    check_time_and_life(recording, into.sample_rate_Hz);
    check_units(recording, into.axis);
    recording.sample_s = 1.0 / into.sample_rate_Hz;
    for (auto& remark : recording_remarks(recording, into.axis)) into.remarks.push_back(std::move(remark));
    all.push_back(std::move(recording));
  }
  return all;
}

}  // namespace

Case read_case(const std::string& path) {
  namespace fs = std::filesystem;
  const bool folder = fs::is_directory(path);
  Case result;
  result.folder = folder ? path : fs::path(path).parent_path().string();
  result.file = folder ? (fs::path(path) / "case.toml").string() : path;
  TomlFile file = TomlFile::read(result.file);
  const auto axis = file.text("axis");
  if (!axis) file.fail("axis", "missing; expected the name of the axis file");
  result.axis = read_axis_file((fs::path(result.folder) / *axis).string());
  result.sample_rate_Hz = file.required_number("sample_rate_Hz", 1.0, 1e6);
  const ChannelMap map = channel_map(file);
  result.controller = controller(file, result);
  const bool named = file.has("fit");
  const auto fit = file.texts("fit"), holdout = file.texts("holdout");
  file.reject_unknown();
  if (!named || fit.empty()) file.fail("fit", "missing; expected a list of recordings");
  for (const auto& name : holdout) {
    if (std::ranges::find(fit, name) != fit.end()) file.fail("holdout", fmt::format("'{}' is in fit too", name));
  }
  result.fit = recordings(file, "fit", map, result);
  result.holdout = recordings(file, "holdout", map, result);
  if (const std::size_t readings = readings_of_one_window(result.fit); readings > 1) {
    result.remarks.push_back(
        fmt::format("the power meter shows each window {} times: the mean of these is taken", readings));
    for (auto* some : {&result.fit, &result.holdout})
      for (auto& recording : *some) join_readings(recording, readings);
  }
  const MeterHabit meter = meter_habit(result.fit, result.axis);
  for (auto* some : {&result.fit, &result.holdout})
    for (auto& recording : *some) recording.meter = meter;
  for (const auto& recording : result.fit) {
    if (result.controller && !recording.has(channel::reference_m)) {
      file.fail("controller", fmt::format("a controller needs reference_m, which {} lacks", recording.file));
    }
  }
  return result;
}

}  // namespace feedtwin::tools
