#include "tools/diagnose/forward/likelihood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "tools/identify/channel_residuals.h"
#include "tools/identify/innovations.h"
#include "tools/identify/sliding.h"
#include "tools/median.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double stretch_s = 0.25;

/// A channel's residuals of all runs, later their log densities, and the stretch that each is of.
struct Channel {
  std::vector<std::vector<double>> residuals;
  std::vector<std::vector<std::size_t>> stretch;

  /// Before the motor's friction has set in its sensor tells nothing that a model here foresees.
  void take_sliding(const std::vector<double>& all, const std::vector<std::size_t>& at, const std::vector<bool>& slides) {
    const auto row = [](const auto& values, std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
    for (const auto& [first, end] : stretches_of(slides)) {
      residuals.emplace_back(row(all, first), row(all, end));
      stretch.emplace_back(row(at, first), row(at, end));
    }
  }

  /// Of their innovations, in place of the residuals.
  void take_densities() {
    if (residuals.empty()) return;
    const auto innovations = innovations_of(residuals);
    for (std::size_t r = 0; r < residuals.size(); ++r)
      std::ranges::transform(innovations.values[r], residuals[r].begin(),
                             [&](double value) { return innovations.log_density(value); });
  }
};

void even_out_power(std::vector<double>& residual, const Recording& recording, const MeteredPower& meter) {
  const auto power_W = recording.at(channel::power_W);
  double squares = 0.0;
  for (const std::size_t row : meter.rows) squares += power_W[row] * power_W[row];
  const double rms_W = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, meter.rows.size())));
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] /= error_scale_W(power_W[meter.rows[i]], rms_W, recording.meter.errors_alike);
}

}  // namespace

double Likelihood::total() const {
  return std::accumulate(stretches.begin(), stretches.end(), 0.0);
}

Likelihood likelihood(const ForwardModel& forward, const AxisByRun& axis) {
  const auto simulated = forward.simulate(axis);
  std::array<Channel, fitted_channels.size()> channels;
  Likelihood found;
  for (std::size_t r = 0; r < forward.runs().size(); ++r) {
    const auto& recording = forward.runs()[r].recording();
    const auto meter = metered_rows(recording, forward.runs()[r].nominal());
    auto residuals = channel_residuals(recording, meter, simulated[r]);
    const std::size_t first = found.stretches.size();
    const auto length = static_cast<std::size_t>(std::max(1.0, std::round(stretch_s / recording.sample_s)));
    found.stretches.resize(first + recording.size() / length + 1, 0.0);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (residuals[c].empty()) continue;
      const bool metered = fitted_channels[c] == channel::power_W;
      if (metered) even_out_power(residuals[c], recording, meter);
      std::vector<std::size_t> at(residuals[c].size());
      for (std::size_t i = 0; i < at.size(); ++i) at[i] = first + (metered ? meter.rows[i] : i) / length;
      if (fitted_channels[c] == channel::torque_sensor_Nm) {
        channels[c].take_sliding(residuals[c], at, forward.runs()[r].motor_slides());
        continue;
      }
      channels[c].residuals.push_back(std::move(residuals[c]));
      channels[c].stretch.push_back(std::move(at));
    }
  }
  parallel_for(channels.size(), [&](std::size_t c) { channels[c].take_densities(); });
  for (const auto& channel : channels)
    for (std::size_t r = 0; r < channel.residuals.size(); ++r)
      for (std::size_t i = 0; i < channel.residuals[r].size(); ++i)
        found.stretches[channel.stretch[r][i]] += channel.residuals[r][i];
  return found;
}

Comparison compared(const Likelihood& one, const Likelihood& other) {
  // a stretch's say in the deviations, or two of them outvote all others; but of what a single tick cannot make
  constexpr double most_of_a_median = 10.0, beyond_a_tick = 50.0;
  const std::size_t n = std::min(one.stretches.size(), other.stretches.size());
  if (n == 0) return {};
  std::vector<double> difference(n), size(n);
  for (std::size_t i = 0; i < n; ++i) {
    difference[i] = one.stretches[i] - other.stretches[i];
    size[i] = std::abs(difference[i]);
  }
  const double nats = std::accumulate(difference.begin(), difference.end(), 0.0);
  const double most = std::max(most_of_a_median * median_of(std::move(size)), beyond_a_tick);
  double sum = 0.0, squares = 0.0;
  for (double& d : difference) sum += d = std::clamp(d, -most, most);
  const double mean = sum / static_cast<double>(n);
  for (const double d : difference) squares += (d - mean) * (d - mean);
  return {nats, sum / (std::sqrt(squares) + 1e-9)};
}

}  // namespace feedtwin::tools::diagnosis
