#include "tools/identify/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tools/identify/channel_residuals.h"
#include "tools/identify/inverse_model.h"
#include "tools/identify/zero_phase_filter.h"

namespace feedtwin::tools {
namespace {

TrackingError tracking_error(std::span<const double> reference_m, std::span<const double> position_m) {
  const auto m = channel_metrics(reference_m, position_m, 0.0);
  return {m.peak, m.rms};
}

void compare_closed_loop(const Case& recordings, const plant::AxisParameters& parameters, RunComparison& into) {
  const Recording& recording = *into.recording;
  const ClosedLoopRun run(recording, recordings.axis, recordings.controller);
  plant::FeedAxis axis(without_stops(parameters));
  into.simulated = simulate_closed_loop(run, axis);
  if (recording.has(channel::power_W)) {
    const auto meter = metered_rows(recording, parameters);
    into.simulated.power_W = as_metered(into.simulated.power_W, meter);
  }
  const auto only_if = [&recording](std::string_view name, const std::vector<double>& values) {
    return recording.has(name) ? std::span<const double>(values) : std::span<const double>{};
  };
  into.energy_simulated =
      component_energy({into.simulated.torque_Nm, into.simulated.position_m,
                        only_if(channel::torque_sensor_Nm, into.simulated.torque_sensor_Nm),
                        only_if(channel::force_sensor_N, into.simulated.force_sensor_N),
                        only_if(channel::power_W, into.simulated.power_W), parameters.axis.lead_m, recording.sample_s});
  for (const auto name : {channel::torque_cmd_Nm, channel::position_m, channel::scale_position_m, channel::torque_sensor_Nm,
                          channel::force_sensor_N, channel::power_W}) {
    if (!recording.has(name)) continue;
    into.closed_loop.emplace(
        name, channel_metrics(recording.at(name), simulated_channel(into.simulated, name), recording.sample_s));
  }
}

void compare_inverse_model(const plant::AxisParameters& parameters, RunComparison& into) {
  const Recording& recording = *into.recording;
  const auto motion = recorded_motion(recording, parameters.axis.lead_m);
  into.inverse_recorded_N = decimated(motion.force_N, motion.decimation);
  into.inverse_simulated_N = decimated(inverse_force_N(parameters, motion, recording.sample_s), motion.decimation);
  const double step_s = recording.sample_s * motion.decimation;
  for (std::size_t i = 0; i < into.inverse_recorded_N.size(); ++i)
    into.inverse_time_s.push_back(static_cast<double>(i) * step_s);
  const double to_torque =
      recording.at(channel::torque_cmd_Nm).empty() ? 1.0 : parameters.axis.lead_m / (2.0 * std::numbers::pi);
  std::vector<double> recorded(into.inverse_recorded_N), simulated(into.inverse_simulated_N);
  for (double& value : recorded) value *= to_torque;
  for (double& value : simulated) value *= to_torque;
  into.inverse_model.emplace(channel::torque_cmd_Nm, channel_metrics(recorded, simulated, step_s));
}

MetricsByChannel pooled_over(const std::vector<RunComparison>& runs, MetricsByChannel RunComparison::* part) {
  std::map<std::string, std::vector<ChannelMetrics>> by_channel;
  for (const auto& run : runs) {
    for (const auto& [name, metrics] : run.*part) by_channel[name].push_back(metrics);
  }
  MetricsByChannel all;
  for (const auto& [name, metrics] : by_channel) all.emplace(name, pooled(metrics));
  return all;
}

nlohmann::json to_json(const ChannelMetrics& m) {
  return {{"peak", m.peak},
          {"rms", m.rms},
          {"rel_error", m.rel_error},
          {"nrmse", m.nrmse},
          {"correlation", m.correlation},
          {"delay_s", m.delay_s},
          {"recorded_peak", m.recorded_peak},
          {"recorded_rms", m.recorded_rms},
          {"samples", m.samples}};
}

nlohmann::json to_json(const MetricsByChannel& channels) {
  auto out = nlohmann::json::object();
  for (const auto& [name, metrics] : channels) out[name] = to_json(metrics);
  return out;
}

nlohmann::json to_json(const ComponentEnergy& energy) {
  nlohmann::json out{{"input_work", energy.input_work_J}};
  const auto put = [&out](const char* name, const std::optional<double>& value) {
    if (value) out[name] = *value;
  };
  put("motor_electrical", energy.motor_electrical_J);
  put("motor_mechanical", energy.motor_mechanical_J);
  put("ball_screw", energy.ball_screw_J);
  put("guide", energy.guide_J);
  put("total", energy.total_J);
  return out;
}

}  // namespace

CaseComparison compare_case(const Case& recordings, const plant::AxisParameters& axis) {
  CaseComparison comparison;
  const auto add = [&](const Recording& recording, bool holdout) {
    RunComparison run;
    run.recording = &recording;
    run.holdout = holdout;
    compare_closed_loop(recordings, axis, run);
    compare_inverse_model(axis, run);
    const auto reference = recording.at(channel::reference_m);
    if (!reference.empty()) {
      run.tracking_recorded = tracking_error(reference, recording.at(channel::position_m));
      run.tracking_simulated = tracking_error(reference, run.simulated.position_m);
    }
    run.energy_recorded = component_energy({recording.at(channel::torque_cmd_Nm), recording.at(channel::position_m),
                                            recording.at(channel::torque_sensor_Nm), recording.at(channel::force_sensor_N),
                                            recording.at(channel::power_W), axis.axis.lead_m, recording.sample_s});
    comparison.runs.push_back(std::move(run));
  };
  for (const auto& recording : recordings.fit) add(recording, false);
  for (const auto& recording : recordings.holdout) add(recording, true);
  comparison.closed_loop = pooled_over(comparison.runs, &RunComparison::closed_loop);
  comparison.inverse_model = pooled_over(comparison.runs, &RunComparison::inverse_model);
  return comparison;
}

nlohmann::json to_json(const CaseComparison& comparison) {
  nlohmann::json out{{"channels", to_json(comparison.closed_loop)},
                     {"closed_loop", {{"channels", to_json(comparison.closed_loop)}}},
                     {"inverse_model", {{"channels", to_json(comparison.inverse_model)}}},
                     {"recordings", nlohmann::json::array()}};
  for (const auto& run : comparison.runs) {
    nlohmann::json one{
        {"file", run.recording->file},
        {"role", run.holdout ? "holdout" : "fit"},
        {"closed_loop", {{"channels", to_json(run.closed_loop)}}},
        {"inverse_model", {{"channels", to_json(run.inverse_model)}}},
        {"energy_J", {{"recorded", to_json(run.energy_recorded)}, {"simulated", to_json(run.energy_simulated)}}}};
    if (run.tracking_recorded) {
      one["tracking_error_m"] = {
          {"recorded", {{"peak", run.tracking_recorded->peak_m}, {"rms", run.tracking_recorded->rms_m}}},
          {"simulated", {{"peak", run.tracking_simulated->peak_m}, {"rms", run.tracking_simulated->rms_m}}}};
    }
    out["recordings"].push_back(std::move(one));
  }
  return out;
}

std::vector<Figure> figures_of(const CaseComparison& comparison, const plant::AxisParameters& axis) {
  std::vector<Figure> figures;
  for (const auto& run : comparison.runs) {
    const Recording& recording = *run.recording;
    const auto time_s = recording.at(channel::time_s);
    const std::string file = std::filesystem::path(recording.file).filename().string() + (run.holdout ? " (holdout)" : "");
    for (const auto& kind : channel_kinds()) {
      const auto simulated = simulated_channel(run.simulated, kind.name);
      const auto recorded = recording.at(kind.name);
      if (recorded.empty() || simulated.empty() || kind.name == channel::position_m ||
          kind.name == channel::scale_position_m)
        continue;
      std::vector<double> residual(recorded.size());
      for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = recorded[i] - simulated[i];
      figures.push_back({file + ": " + std::string(kind.name) + ", closed loop",
                         {"time", "s"},
                         {std::string(kind.name), std::string(kind.unit)},
                         {thinned("recorded", time_s, recorded), thinned("simulated", time_s, simulated),
                          thinned("residual", time_s, residual)}});
    }
    figures.push_back({file + ": force, inverse model",
                       {"time", "s"},
                       {"force at the table", "N"},
                       {thinned("recorded", run.inverse_time_s, run.inverse_recorded_N),
                        thinned("model", run.inverse_time_s, run.inverse_simulated_N)}});
    const auto motion = recorded_motion(recording, axis.axis.lead_m);
    FigureSeries recorded_friction{"recorded", {}, {}, true}, model_friction{"model", {}, {}, true};
    const auto modelled = inverse_force_N(axis, motion, recording.sample_s);
    const double mass_kg = plant::make_axis_model(axis).mass_kg;
    const std::size_t step = std::max<std::size_t>(1, motion.force_N.size() / 1500);
    for (std::size_t i = 0; i < motion.force_N.size(); i += step) {
      const double inertial_N = mass_kg * motion.acceleration_m_per_s2[i];
      recorded_friction.x.push_back(motion.velocity_m_per_s[i]);
      recorded_friction.y.push_back(motion.force_N[i] - inertial_N);
      model_friction.x.push_back(motion.velocity_m_per_s[i]);
      model_friction.y.push_back(modelled[i] - inertial_N);
    }
    figures.push_back({file + ": friction over speed",
                       {"velocity", "m/s"},
                       {"force less inertia", "N"},
                       {recorded_friction, model_friction}});
  }
  return figures;
}

std::string to_text(const CaseComparison& comparison) {
  std::string out;
  const auto table = [&out](const char* title, const MetricsByChannel& channels) {
    out += fmt::format("{:<18} {:>12} {:>12} {:>10} {:>10} {:>12} {:>10}\n", title, "peak error", "rms error", "rel_error",
                       "nrmse", "correlation", "delay_ms");
    for (const auto& [name, m] : channels) {
      out += fmt::format("  {:<16} {:>12.5g} {:>12.5g} {:>9.3f}% {:>9.3f}% {:>12.6f} {:>10.4f}\n", name, m.peak, m.rms,
                         100.0 * m.rel_error, 100.0 * m.nrmse, m.correlation, 1e3 * m.delay_s);
    }
  };
  for (const auto& run : comparison.runs) {
    out += fmt::format("{}{}\n", run.recording->file, run.holdout ? " (holdout)" : "");
    table(" closed loop", run.closed_loop);
    table(" inverse model", run.inverse_model);
    if (run.tracking_recorded) {
      out += fmt::format(" tracking error in um: recorded peak {:.2f}, rms {:.2f}; simulated peak {:.2f}, rms {:.2f}\n",
                         1e6 * run.tracking_recorded->peak_m, 1e6 * run.tracking_recorded->rms_m,
                         1e6 * run.tracking_simulated->peak_m, 1e6 * run.tracking_simulated->rms_m);
    }
    const auto energy = [&out](const char* name, const std::optional<double>& recorded,
                               const std::optional<double>& simulated) {
      if (recorded && simulated) out += fmt::format("  {:<28} {:>10.3f} {:>10.3f}\n", name, *recorded, *simulated);
    };
    out += fmt::format("  {:<28} {:>10} {:>10}\n", "energy in J", "recorded", "simulated");
    energy("motor, electrical", run.energy_recorded.motor_electrical_J, run.energy_simulated.motor_electrical_J);
    energy("motor, mechanical", run.energy_recorded.motor_mechanical_J, run.energy_simulated.motor_mechanical_J);
    energy("ball screw", run.energy_recorded.ball_screw_J, run.energy_simulated.ball_screw_J);
    energy("guide", run.energy_recorded.guide_J, run.energy_simulated.guide_J);
    energy("input work", run.energy_recorded.input_work_J, run.energy_simulated.input_work_J);
  }
  out += "all runs\n";
  table(" closed loop", comparison.closed_loop);
  table(" inverse model", comparison.inverse_model);
  return out;
}

}  // namespace feedtwin::tools
