#include "tools/diagnose/hil.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "tools/config/input_error.h"
#include "tools/config/server_config.h"
#include "tools/identify/channel_residuals.h"
#include "tools/loopback/recorded_path.h"
#include "tools/loopback/tracking_gains.h"
#include "tools/recording/csv.h"
#include "tools/run/plant_run.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// A folder for the logs, gone with the object.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "feedtwin-hil-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw InputError("cannot make a folder in " + name);
    path_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] std::string operator/(const char* file) const { return (path_ / file).string(); }

 private:
  std::filesystem::path path_;
};

ServerConfig server_for(const HilRequest& request, const Recording& recording, const plant::AxisParameters& axis,
                        const std::string& log) {
  ServerConfig config = read_server_config({.path = "", .controller = "loopback", .with_ports = false});
  config.source = request.data.file;
  config.axes = {axis};
  config.axis_sources = {request.data.file};
  config.loop.tick_s = recording.sample_s;
  LoopbackSettings loopback;
  const auto kinds = controllers::motion_kinds();
  loopback.motion = &*std::ranges::find(kinds, "recorded", &controllers::MotionKind::name);
  const auto& known = request.data.controller;
  loopback.motion_settings.path =
      known ? recorded_reference(recording) : recorded_motion_path(recording, request.nominal.axis.lead_m);
  loopback.gains = known.value_or(stand_in_gains(request.nominal));
  config.loopback = {loopback};
  config.log_path = log;
  return config;
}

/// A channel as the server logged it, by tick; what a missed tick would have shown is left at the tick before.
std::vector<double> by_tick(const Table& log, std::string_view name, double tick_s, std::size_t ticks) {
  const Column* time_s = log.find("time_s");
  const Column* values = log.find(name);
  std::vector<double> out(ticks, 0.0);
  if (time_s == nullptr || values == nullptr) return out;
  std::size_t row = 0;
  for (std::size_t k = 0; k < ticks; ++k) {
    while (row + 1 < values->values.size() && time_s->values[row + 1] <= (static_cast<double>(k) + 0.5) * tick_s) ++row;
    if (row < values->values.size()) out[k] = values->values[row];
  }
  return out;
}

double at(std::span<const double> values, double place) {
  const double inside = std::clamp(place, 0.0, static_cast<double>(values.size() - 1));
  const auto before = static_cast<std::size_t>(inside);
  const std::size_t after = std::min(before + 1, values.size() - 1);
  return values[before] + (inside - static_cast<double>(before)) * (values[after] - values[before]);
}

/// Samples by which a motion comes after another: where their distance is least, on a parabola through the three nearest.
double lateness(std::span<const double> recorded_m, std::span<const double> served_m) {
  constexpr int most = 20;
  const auto distance = [&](int shift) {
    double sum = 0.0;
    for (std::size_t k = most; k + most < recorded_m.size(); ++k)
      sum += std::pow(served_m[static_cast<std::size_t>(static_cast<int>(k) + shift)] - recorded_m[k], 2);
    return sum;
  };
  int best = 0;
  for (int shift = -most + 1; shift < most; ++shift)
    if (distance(shift) < distance(best)) best = shift;
  const double left = distance(best - 1), here = distance(best), right = distance(best + 1),
               bend = left - 2.0 * here + right;
  return best + (bend > 0.0 ? 0.5 * (left - right) / bend : 0.0);
}

/// What the server logged in the place of a simulation, brought to the recording's time.
Simulated served(const Table& log, double tick_s, std::size_t ticks, double late_samples) {
  Simulated out;
  const auto take = [&](std::string_view name, std::vector<double>& into) {
    const auto values = by_tick(log, name, tick_s, ticks);
    into.resize(ticks);
    for (std::size_t k = 0; k < ticks; ++k) into[k] = at(values, static_cast<double>(k) + late_samples);
  };
  take("torque_cmd_Nm", out.torque_Nm);
  take("position_m", out.position_m);
  take("scale_position_m", out.scale_position_m);
  take("torque_sensor_Nm", out.torque_sensor_Nm);
  take("force_sensor_N", out.force_sensor_N);
  out.power_W = by_tick(log, "power_W", tick_s, ticks);  // a meter's readings are compared as they stand
  return out;
}

Recording beginning_of(const Recording& whole, std::size_t rows) {
  Recording part = whole;
  for (auto& [name, values] : part.channels) values.resize(rows);
  return part;
}

void measure(const Recording& recording, const Simulated& simulated, HilRun& into) {
  const auto power = recording.at(channel::power_W);
  const MeteredPower meter = power.empty() ? MeteredPower{} : metered_rows(power);
  const auto residuals = channel_residuals(recording, {}, simulated);
  for (std::size_t c = 0; c < fitted_channels.size(); ++c) {
    const auto recorded = recording.at(fitted_channels[c]);
    if (recorded.empty()) continue;
    std::vector<double> shown(recorded.begin(), recorded.end()), residual = residuals[c];
    if (fitted_channels[c] == channel::power_W) {
      shown.clear(), residual.clear();
      for (const std::size_t row : meter.rows) {  // amid the time that both meters hold the reading
        const std::size_t amid = std::min(row + meter.window / 2, recorded.size() - 1);
        shown.push_back(recorded[amid]);
        residual.push_back(simulated.power_W[amid] - recorded[amid]);
      }
    }
    double mean = 0.0, signal = 0.0, left = 0.0;
    for (const double y : shown) mean += y / static_cast<double>(shown.size());
    for (const double y : shown) signal += (y - mean) * (y - mean);
    for (const double r : residual) left += r * r;
    if (signal > 0.0) into.nrmse[std::string(fitted_channels[c])] = std::sqrt(left / signal);
  }
}

HilRun one_run(const HilRequest& request, const Recording& recording, const plant::AxisParameters& axis,
               const std::string& log) {
  const auto ticks = static_cast<std::uint64_t>(recording.size());
  HilRun run;
  {
    PlantRun plant(server_for(request, recording, axis, log), ticks);
    std::atomic<bool> stop{false};
    plant.run_in_real_time(stop);
    const RunSummary summary = plant.summary("serve");
    run.ticks = summary.stats->ticks;
    run.missed_ticks = summary.stats->missed_ticks;
    run.verdict = std::string(rt::name(summary.verdict.verdict));
  }
  const Table table = read_csv(log);
  const auto moved = by_tick(table, "position_m", recording.sample_s, recording.size());
  const double late_samples = lateness(recording.at(channel::position_m), moved);
  run.delay_s = late_samples * recording.sample_s;
  measure(recording, served(table, recording.sample_s, recording.size(), late_samples), run);
  return run;
}

}  // namespace

HilComparison run_hil(const HilRequest& request, const std::function<void(std::string_view)>& progress) {
  if (request.data.holdout.empty())
    throw InputError(request.data.file + ": holdout: a run of the server needs a held-out recording");
  const Recording& whole = request.data.holdout.front();
  const auto wanted = static_cast<std::size_t>(request.duration_s / whole.sample_s);
  const Recording recording = beginning_of(whole, wanted > 0 ? std::min(wanted, whole.size()) : whole.size());
  const Scratch scratch;
  HilComparison found;
  found.recording = whole.file;
  found.duration_s = recording.duration_s();
  progress(fmt::format("the server runs the nominal axis for {:.0f} s", found.duration_s));
  found.before = one_run(request, recording, request.nominal, scratch / "before.csv");
  progress(fmt::format("the server runs the updated axis for {:.0f} s", found.duration_s));
  found.after = one_run(request, recording, request.updated, scratch / "after.csv");
  return found;
}

}  // namespace feedtwin::tools::diagnosis
