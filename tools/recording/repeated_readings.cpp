#include "tools/recording/repeated_readings.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "tools/recording/power_meter.h"

namespace feedtwin::tools {
namespace {

/// Squares of the steps from one reading to the next: within a window of so many, and from window to window.
struct Steps {
  double within = 0.0, across = 0.0;
  std::size_t first = 0;  ///< reading that begins a window
};

Steps steps_of(std::span<const double> power_W, const std::vector<std::size_t>& rows, std::size_t readings) {
  Steps best{.within = 1e300};
  for (std::size_t first = 0; first < readings; ++first) {
    Steps steps{.first = first};
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double step_W = power_W[rows[i]] - power_W[rows[i - 1]];
      ((i + readings - first) % readings == 0 ? steps.across : steps.within) += step_W * step_W;
    }
    if (steps.within < best.within) best = steps;
  }
  return best;
}

}  // namespace

std::size_t readings_of_one_window(std::span<const Recording> recordings) {
  constexpr std::size_t most = 10, least_windows = 8;
  // of the steps from window to window: of 700 cases whose meter shows each window once the least was 0.06
  constexpr double nearly_none = 0.005;
  std::vector<std::pair<std::span<const double>, MeteredPower>> meters;
  for (const auto& recording : recordings) {
    const auto power_W = recording.at(channel::power_W);
    MeteredPower meter = metered_rows(power_W);
    if (meter.window > 1) meters.emplace_back(power_W, std::move(meter));
  }
  for (std::size_t readings = most; readings > 1; --readings) {
    Steps all;
    std::size_t windows = 0;
    for (const auto& [power_W, meter] : meters) {
      const Steps steps = steps_of(power_W, meter.rows, readings);
      all.within += steps.within, all.across += steps.across;
      windows += meter.rows.size() / readings;
    }
    if (windows >= least_windows && all.within < nearly_none * all.across) return readings;
  }
  return 1;
}

void join_readings(Recording& recording, std::size_t readings) {
  const auto power = recording.channels.find(channel::power_W);
  if (power == recording.channels.end() || readings < 2) return;
  auto& power_W = power->second;
  const auto rows = metered_rows(power_W).rows;
  const std::size_t first = steps_of(power_W, rows, readings).first;
  if (first > 0 && first < rows.size() && rows[0] > 0)  // of a window that began before the run
    std::fill(power_W.begin() + static_cast<std::ptrdiff_t>(rows[0]),
              power_W.begin() + static_cast<std::ptrdiff_t>(rows[first]), power_W[rows[0] - 1]);
  for (std::size_t i = first; i < rows.size(); i += readings) {
    const std::size_t next = i + readings < rows.size() ? rows[i + readings] : power_W.size();
    const std::span<double> held = std::span(power_W).subspan(rows[i], next - rows[i]);
    const double mean_W = std::accumulate(held.begin(), held.end(), 0.0) / static_cast<double>(held.size());
    std::ranges::fill(held, mean_W);
  }
}

}  // namespace feedtwin::tools
