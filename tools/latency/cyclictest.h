#pragma once
// cyclictest (rt-tests) as the yardstick of wake-up latency: run beside the loop, same core, priority and period.

#include <map>
#include <optional>
#include <string>

namespace feedtwin::tools {

struct CyclictestSettings {
  int priority = 80;
  int cpu = -1;
  double duration_s = 10.0;
  double period_s = 1e-3;
};

/// Wake-up latencies in whole us, as cyclictest counts them.
struct CyclictestResult {
  std::map<int, std::uint64_t> histogram;
  std::uint64_t total = 0;
  /// The latency that `share` of the wake-ups do not exceed.
  [[nodiscard]] double percentile_us(double share) const;
};

[[nodiscard]] bool cyclictest_is_installed();

/// Blocks for the duration. Nothing when it can't be run or its answer can't be read.
[[nodiscard]] std::optional<CyclictestResult> run_cyclictest(const CyclictestSettings& settings);

}  // namespace feedtwin::tools
