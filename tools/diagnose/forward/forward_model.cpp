#include "tools/diagnose/forward/forward_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "tools/diagnose/forward/rulings_before.h"
#include "tools/identify/channel_residuals.h"
#include "tools/identify/whitening.h"
#include "tools/median.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// The stand-in follows the recorded motion half as tightly as where numbers are identified: what the encoder's grid then
/// leaves in the command is a quarter (practice cases: 0.0006 of the command instead of 0.0023), and friction shows as
/// before.
constexpr StandInSettings following{.bandwidth_rad_per_s = 75.0, .damping_ratio = 0.9, .filter_rad_per_s = 400.0};

/// Squares of residual and of signal about its mean.
struct Squares {
  double residual = 0.0, signal = 0.0;
};
using SquaresByChannel = std::map<std::string, Squares>;

void add_squares(const ClosedLoopRun& run, const Simulated& simulated, SquaresByChannel& sums) {
  const Recording& recording = run.recording();
  const auto meter = metered_rows(recording, run.nominal());
  const auto residuals = channel_residuals(recording, meter, simulated);
  for (std::size_t c = 0; c < fitted_channels.size(); ++c) {
    if (residuals[c].empty()) continue;
    const auto recorded = recording.at(fitted_channels[c]);
    std::vector<double> shown(recorded.begin(), recorded.end());
    if (fitted_channels[c] == channel::power_W) {
      shown.clear();
      for (const std::size_t row : meter.rows) shown.push_back(recorded[row]);
    }
    double mean = 0.0;
    for (const double y : shown) mean += y / static_cast<double>(shown.size());
    auto& sum = sums[std::string(fitted_channels[c])];
    for (const double y : shown) sum.signal += (y - mean) * (y - mean);
    for (const double r : residuals[c]) sum.residual += r * r;
  }
}

Nrmse as_nrmse(const SquaresByChannel& sums) {
  Nrmse found;
  for (const auto& [name, sum] : sums)
    if (sum.signal > 0.0) found[name] = std::sqrt(sum.residual / sum.signal);
  return found;
}

/// What the simulated axis would have recorded: its position on the encoder's grid, its sensors with their noise.
Recording as_recorded(const ClosedLoopRun& run, const Simulated& simulated, double count_m, double meter_share) {
  const Recording& original = run.recording();
  Recording made = original;
  std::mt19937 random(20190410);  // NOLINT(bugprone-random-generator-seed): the same answer for the same input
  std::normal_distribution<double> normal;
  for (const auto name : fitted_channels) {
    const auto found = made.channels.find(name);
    if (found == made.channels.end()) continue;
    auto& values = found->second;
    const auto model = simulated_channel(simulated, name);
    if (name == channel::power_W) {
      const auto meter = metered_rows(original, run.nominal());
      values = as_metered(model, meter);
      double error_W = 0.0;
      auto next = meter.rows.begin();
      for (std::size_t k = 0; k < values.size(); ++k) {
        const double of_W = original.meter.errors_alike ? 1.0 : values[k];
        if (next != meter.rows.end() && *next == k) error_W = meter_share * of_W * normal(random), ++next;
        values[k] += error_W;
      }
      continue;
    }
    const double sigma = name == channel::torque_cmd_Nm ? 0.0 : white_sigma(original.at(name));
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = model[k] + (sigma > 0.0 ? sigma * normal(random) : 0.0);
  }
  auto& position = made.channels.at(std::string(channel::position_m));
  for (std::size_t k = 0; k < position.size(); ++k)
    position[k] = std::floor(simulated.position_m[k] / count_m + 0.37) * count_m;  // where the grid stands is chance
  return made;
}

}  // namespace

ForwardModel::ForwardModel(const std::vector<Recording>& recordings, const Case& data, std::uint64_t most_samples)
    : data_(&data), most_samples_(most_samples), before_(std::make_shared<RulingsBefore>()) {
  runs_.reserve(recordings.size());
  for (const auto& recording : recordings) runs_.emplace_back(recording, data.axis, data.controller, following);
}

Simulated ForwardModel::simulated(const ClosedLoopRun& run, const plant::AxisParameters& parameters) const {
  std::vector<Simulated> made(1);
  simulate_alike(run, {parameters}, {0}, made);
  return std::move(made.front());
}

/// @param alike places of axes that differ electrically at most: the first is simulated, and its motion is all others'
void ForwardModel::simulate_alike(const ClosedLoopRun& run, const std::vector<plant::AxisParameters>& axes,
                                  const std::vector<std::size_t>& alike, std::vector<Simulated>& all) const {
  const auto& recording = run.recording();
  const plant::AxisParameters& moved = axes[alike.front()];
  plant::FeedAxis axis(without_stops(moved));
  const bool sensors = recording.has(channel::torque_sensor_Nm) || recording.has(channel::force_sensor_N);
  ElectricalTerms terms;
  Simulated made = simulate_closed_loop(run, axis, 0.0, sensors, alike.size() > 1 ? &terms : nullptr);
  *simulated_samples_ += recording.size();
  for (const std::size_t i : alike)
    if (i != alike.front()) all[i] = with_electrical(made, terms, moved.motor, axes[i].motor);
  all[alike.front()] = std::move(made);
  for (const std::size_t i : alike)
    if (recording.meter.instants) all[i].power_W.swap(all[i].instant_power_W);
}

std::vector<Simulated> ForwardModel::simulate(const ClosedLoopRun& run,
                                              const std::vector<plant::AxisParameters>& axes) const {
  std::vector<plant::AxisParameters> moving;  // a number of another run's changes nothing in this one; nan is like nothing
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    auto own = without_electrical(axes[i]);
    const auto known = std::ranges::find(moving, own);
    if (known != moving.end()) {
      groups[static_cast<std::size_t>(known - moving.begin())].push_back(i);
    } else {
      moving.push_back(std::move(own));
      groups.push_back({i});
    }
  }
  std::vector<Simulated> all(axes.size());
  parallel_for(groups.size(), [&](std::size_t g) { simulate_alike(run, axes, groups[g], all); });
  return all;
}

std::vector<Simulated> ForwardModel::simulate(const AxisByRun& axis) const {
  std::vector<Simulated> all(runs_.size());
  parallel_for(runs_.size(), [&](std::size_t r) { all[r] = simulated(runs_[r], axis.of(r)); });
  return all;
}

void ForwardModel::learn_meter_noise(const AxisByRun& axis) {
  const auto power = std::ranges::find(fitted_channels, channel::power_W) - fitted_channels.begin();
  const auto simulated = simulate(axis);
  std::vector<double> shares;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const auto recorded = runs_[r].recording().at(channel::power_W);
    if (recorded.empty()) return;
    const auto meter = metered_rows(runs_[r].recording(), runs_[r].nominal());
    const auto residual = channel_residuals(runs_[r].recording(), meter, simulated[r])[static_cast<std::size_t>(power)];
    for (std::size_t i = 1; i < residual.size(); ++i) {
      const double reading_W = runs_[r].recording().meter.errors_alike
                                   ? std::numbers::sqrt2
                                   : std::hypot(recorded[meter.rows[i]], recorded[meter.rows[i - 1]]);
      if (reading_W > 0.0) shares.push_back(std::abs(residual[i] - residual[i - 1]) / reading_W);
    }
  }
  if (shares.empty()) return;
  meter_share_ = 1.4826 * median_of(std::move(shares));
}

Nrmse ForwardModel::nrmse(const AxisByRun& axis) const {
  const auto simulated = simulate(axis);
  SquaresByChannel sums;
  for (std::size_t r = 0; r < runs_.size(); ++r) add_squares(runs_[r], simulated[r], sums);
  return as_nrmse(sums);
}

Nrmse ForwardModel::noise_floor(const AxisByRun& axis) const {
  const auto simulated = simulate(axis);
  const double count_m = axis.common.axis.lead_m / axis.common.axis.encoder_counts_per_rev;
  std::vector<Recording> made;
  for (std::size_t r = 0; r < runs_.size(); ++r) made.push_back(as_recorded(runs_[r], simulated[r], count_m, meter_share_));
  ForwardModel again(made, *data_);
  again.take_meter_from(*this);
  return again.nrmse(axis);
}

}  // namespace feedtwin::tools::diagnosis
