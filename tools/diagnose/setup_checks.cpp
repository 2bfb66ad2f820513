#include "tools/diagnose/setup_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plant/effects/registry.h"
#include "tools/diagnose/late_scale.h"
#include "tools/diagnose/lost_counts.h"
#include "tools/intervals.h"
#include "tools/recording/power_meter.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// Work of a force-like channel along the motion over its magnitude: friction makes it positive.
double work_share(const std::vector<Recording>& runs, std::string_view force, std::string_view position) {
  double work = 0.0, magnitude = 0.0;
  for (const auto& run : runs) {
    const auto f = run.at(force), x = run.at(position);
    for (std::size_t k = 8; k < f.size() && k < x.size(); ++k) {
      const double moved = x[k] - x[k - 8];
      work += f[k] * moved;
      magnitude += std::abs(f[k] * moved);
    }
  }
  return magnitude > 0.0 ? work / magnitude : 0.0;
}

struct Slope {
  double value = 1.0, sigma = 0.0;
};

/// Slope of one position over the other; its deviation from leaving out a second at a time (jackknife).
Slope slope(const std::vector<Recording>& runs, std::string_view of, std::string_view to) {
  constexpr std::size_t apart = 8;
  struct Sums {
    double product = 0.0, square = 0.0;
  };
  std::vector<Sums> seconds;
  Sums all;
  for (const auto& run : runs) {
    const auto y = run.at(of), x = run.at(to);
    const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(1.0 / run.sample_s)));
    for (std::size_t k = apart; k < y.size() && k < x.size(); ++k) {
      if ((k - apart) % rows == 0) seconds.emplace_back();
      const double moved = x[k] - x[k - apart], shown = y[k] - y[k - apart];
      for (auto* sums : {&all, &seconds.back()}) sums->product += shown * moved, sums->square += moved * moved;
    }
  }
  if (!(all.square > 0.0)) return {};
  Slope found{all.product / all.square, 0.0};
  double squares = 0.0;
  for (const auto& one : seconds)
    if (all.square > one.square)
      squares += std::pow((all.product - one.product) / (all.square - one.square) - found.value, 2);
  const auto count = static_cast<double>(seconds.size());
  found.sigma = std::sqrt(squares * (count - 1.0) / count);
  return found;
}

SetupFault reversed(std::string_view name, const char* parameter) {
  return {"wrong_sign",
          "set_up",
          std::string(name),
          fmt::format("{} is wired in reverse: the work that it would do has the wrong sign.", name),
          {{parameter, -1.0, 0.0}}};
}

SetupFault given_back(const LostCounts& lost) {
  return {"count_loss",
          "sensors",
          std::string(channel::position_m),
          fmt::format("the encoder {} {:.0f} counts within a sample, {} times, wherever its shaft was: they are given back.",
                      lost.gained == 0             ? "loses"
                      : lost.gained < lost.moments ? "loses or gains"
                                                   : "gains",
                      lost.counts, lost.moments),
          {{"counts_per_event", lost.gained < lost.moments ? lost.counts : -lost.counts,
            std::max(0.5, normal_90 * lost.deviation)},
           {"events_per_s", lost.per_s, normal_90 * lost.per_s / std::sqrt(lost.moments)}}};
}

SetupFault read_late(const LateScale& late) {
  return {"channel_skew",
          "sensors",
          std::string(channel::scale_position_m),
          fmt::format("the scale is late against the encoder, by {:.3g} ms: it is brought forward.", 1e3 * late.delay_s),
          {{"scale_delay_s", late.delay_s, normal_90 * late.deviation_s}}};
}

/// The power meter's window as the readings show it against the configured one; mends the axis.
std::optional<SetupFault> mend_meter(const Recording& recording, plant::AxisParameters& axis) {
  const MeteredPower meter = metered_rows(recording, axis);
  if (meter.window == 1) return std::nullopt;
  const double shown_s = static_cast<double>(meter.window) * recording.sample_s, half_a_sample_s = 0.5 * recording.sample_s;
  const double readings = recording.meter.readings_a_window;
  double &configured_s = axis.power_meter_window_s, &configured_readings = axis.power_meter_readings;
  if (std::abs(shown_s - configured_s) < 3.0 * half_a_sample_s && readings == configured_readings) return std::nullopt;
  SetupFault fault{
      "power_meter_window",
      "power",
      std::string(channel::power_W),
      fmt::format("the power meter averages over {:.3g} s, not over {:.3g} s as configured", shown_s, configured_s),
      {{"window_s", shown_s, half_a_sample_s}}};
  if (readings != 1.0) {
    fault.sentence += readings > 1.0 ? fmt::format("; each of its windows spans {:.0f} readings", readings)
                                     : fmt::format(", the last {:.0f} % before each reading", 100.0 * readings);
    fault.parameters.push_back({"readings", readings, 0.0});
  }
  fault.sentence += ".";
  configured_s = shown_s, configured_readings = readings;
  return fault;
}

}  // namespace

void multiply(Case& data, std::string_view name, double factor) {
  for (auto* runs : {&data.fit, &data.holdout})
    for (auto& run : *runs)
      if (const auto found = run.channels.find(name); found != run.channels.end())
        for (double& value : found->second) value *= factor;
}

std::vector<SetupFault> mend_setup(Case& data) {
  std::vector<SetupFault> faults;
  constexpr double clear = -0.2;
  const auto has = [&data](std::string_view name) { return !data.fit.empty() && data.fit.front().has(name); };
  const auto mend = [&](std::string_view name, const char* parameter) {
    faults.push_back(reversed(name, parameter));
    multiply(data, name, -1.0);
  };
  const bool scale = has(channel::scale_position_m);
  if (scale && slope(data.fit, channel::scale_position_m, channel::position_m).value < 0.0) {
    // whichever of the two agrees with the torque is right
    if (work_share(data.fit, channel::torque_cmd_Nm, channel::scale_position_m) > 0.0)
      mend(channel::position_m, "encoder_sign");
    else
      mend(channel::scale_position_m, "scale_sign");
  }
  if (work_share(data.fit, channel::torque_cmd_Nm, channel::position_m) < clear) mend(channel::torque_cmd_Nm, "torque_sign");
  for (const auto& [name, parameter] :
       {std::pair{channel::torque_sensor_Nm, "torque_sensor_sign"}, std::pair{channel::force_sensor_N, "force_sensor_sign"}})
    if (has(name) && work_share(data.fit, name, channel::position_m) < clear) mend(name, parameter);

  if (const auto lost = give_back_lost_counts(data)) faults.push_back(given_back(*lost));
  if (const auto late = late_scale(data.fit)) {
    faults.push_back(read_late(*late));
    for (auto* runs : {&data.fit, &data.holdout})
      for (auto& run : *runs) bring_forward(run, *late);
  }
  if (scale) {
    const auto [factor, sigma] = slope(data.fit, channel::scale_position_m, channel::position_m);
    if (std::abs(factor - 1.0) > 0.01) {
      faults.push_back(
          {"wrong_lead",
           "set_up",
           std::string(channel::scale_position_m),
           fmt::format("the lead in the configuration is wrong: the table travels {:.4f} of what the encoder says.", factor),
           {{"factor", factor, normal_90 * sigma}}});
      data.axis.axis.lead_m *= factor;
      multiply(data, channel::position_m, factor);
    }
  }
  if (!data.fit.empty())
    if (auto window = mend_meter(data.fit.front(), data.axis)) faults.push_back(std::move(*window));
  return faults;
}

void show_mended(plant::AxisParameters& axis, const std::vector<SetupFault>& faults) {
  for (const auto& fault : faults) {
    if (fault.id != "channel_skew") continue;
    const auto& entry = *plant::find_effect(fault.id);
    auto setting = plant::preset_of(entry);
    for (const auto& number : fault.parameters) *plant::value_in(setting, entry, number.name) = number.value;
    axis.effects.push_back(std::move(setting));
  }
}

}  // namespace feedtwin::tools::diagnosis
