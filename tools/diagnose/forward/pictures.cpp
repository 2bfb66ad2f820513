#include "tools/diagnose/forward/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/identify/channel_residuals.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t bins = 120, most_points = 1500;
constexpr double longest_since_reversal_s = 0.3;

/// What a sample is shown against.
struct Abscissa {
  Where where;
  const char *title, *label, *unit;
};
constexpr std::array abscissas{Abscissa{Where::position, "position", "position", "m"},
                               Abscissa{Where::velocity, "speed", "velocity", "m/s"},
                               Abscissa{Where::reversal, "time since the last reversal", "time since reversal", "s"},
                               Abscissa{Where::order, "the angle of the screw", "angle in a revolution", "deg"},
                               Abscissa{Where::time, "time", "time in the run", "s"}};

double at(const Track& track, std::size_t sample, Where where, double lead_m) {
  const auto k = std::min(static_cast<Index>(sample), track.size - 1);
  switch (where) {
    case Where::position:
      return track.position_m[k];
    case Where::velocity:
      return track.centred_m_per_s[k];
    case Where::reversal:
      return track.since_reversal_s[k];
    case Where::order: {
      const double turns = track.position_m[k] / lead_m;
      return 360.0 * (turns - std::floor(turns));
    }
    default:
      return static_cast<double>(k) * track.sample_s;
  }
}

/// Remainders of a channel over all runs, with the sample that each is of.
struct Remainder {
  std::vector<double> value;
  std::vector<std::size_t> run, sample;
};

Remainder remainder_of(const ForwardModel& forward, const std::vector<Simulated>& simulated, std::size_t channel_at) {
  Remainder found;
  for (std::size_t r = 0; r < simulated.size(); ++r) {
    const auto& recording = forward.runs()[r].recording();
    const auto meter = metered_rows(recording, forward.runs()[r].nominal());
    const auto residual = channel_residuals(recording, meter, simulated[r])[channel_at];
    const bool metered = fitted_channels[channel_at] == channel::power_W;
    for (std::size_t i = 0; i < residual.size(); ++i) {
      found.value.push_back(-residual[i]);
      found.run.push_back(r);
      found.sample.push_back(metered ? meter.rows[i] - meter.window / 2 : i);
    }
  }
  return found;
}

/// Means over equal stretches of the abscissa: what repeats there, without what does not.
FigureSeries binned(std::string name, const std::vector<double>& x, const std::vector<double>& y) {
  FigureSeries series{std::move(name), {}, {}, false};
  if (x.empty()) return series;
  const auto [low, high] = std::ranges::minmax(x);
  const double per_bin = (high - low) / bins + 1e-300;
  std::array<double, bins> sum{}, count{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto b = std::min(bins - 1, static_cast<std::size_t>((x[i] - low) / per_bin));
    sum[b] += y[i];
    count[b] += 1.0;
  }
  for (std::size_t b = 0; b < bins; ++b) {
    if (count[b] == 0.0) continue;
    series.x.push_back(low + (static_cast<double>(b) + 0.5) * per_bin);
    series.y.push_back(sum[b] / count[b]);
  }
  return series;
}

FigureSeries scattered(std::string name, const std::vector<double>& x, const std::vector<double>& y) {
  FigureSeries series{std::move(name), {}, {}, true};
  const std::size_t step = std::max<std::size_t>(1, x.size() / most_points);
  for (std::size_t i = 0; i < x.size(); i += step) series.x.push_back(x[i]), series.y.push_back(y[i]);
  return series;
}

Figure figure(const Abscissa& against, std::string_view name, std::string_view unit, const std::vector<Track>& tracks,
              double lead_m, const Remainder& before, const Remainder& after, const std::string& what) {
  Figure made{fmt::format("{}: {} left over against {}, held-out runs", what, name, against.title),
              {against.label, against.unit},
              {fmt::format("recorded less simulated {}", name), std::string(unit)},
              {}};
  const auto add = [&](const char* stage, const Remainder& remainder) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < remainder.value.size(); ++i) {
      const double place = at(tracks[remainder.run[i]], remainder.sample[i], against.where, lead_m);
      if (against.where == Where::reversal && place > longest_since_reversal_s) continue;
      x.push_back(place);
      y.push_back(remainder.value[i]);
    }
    made.series.push_back(scattered(stage, x, y));
    if (against.where != Where::time) made.series.push_back(binned(fmt::format("{}, mean", stage), x, y));
  };
  add("before", before);
  add("after", after);
  return made;
}

}  // namespace

std::vector<Figure> pictures(const ForwardModel& forward, const std::vector<Track>& tracks, const Stages& stages,
                             const std::vector<NamedEffect>& named) {
  const auto before = forward.simulate(named.empty() ? stages.nominal : stages.recalibrated);
  const auto after = forward.simulate(stages.updated);
  const double lead_m = stages.nominal.common.axis.lead_m;
  std::vector<Figure> figures;
  const auto show = [&](std::string_view name, Where where, const std::string& what) {
    const auto channel_at = std::ranges::find(fitted_channels, name) - fitted_channels.begin();
    if (channel_at == static_cast<std::ptrdiff_t>(fitted_channels.size())) return;
    const auto c = static_cast<std::size_t>(channel_at);
    const auto left = remainder_of(forward, before, c), still = remainder_of(forward, after, c);
    auto against = std::ranges::find(abscissas, where, &Abscissa::where);
    if (against == abscissas.end()) against = abscissas.end() - 1;  // frequency: over time
    const auto kind = std::ranges::find(channel_kinds(), name, &ChannelKind::name);
    if (!left.value.empty()) figures.push_back(figure(*against, name, kind->unit, tracks, lead_m, left, still, what));
  };
  for (const NamedEffect& one : named)
    show(one.hypothesis->channel, one.hypothesis->where, std::string(told_id(*one.hypothesis)));
  const std::string all = named.empty() ? "recalibration" : "the whole mismatch";
  for (const auto where : {Where::position, Where::velocity, Where::reversal, Where::time})
    show(channel::torque_cmd_Nm, where, all);
  for (const auto name : {channel::torque_sensor_Nm, channel::force_sensor_N, channel::power_W, channel::scale_position_m})
    show(name, Where::time, all);
  return figures;
}

}  // namespace feedtwin::tools::diagnosis
