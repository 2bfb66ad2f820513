#pragma once
// Whether a run can be trusted, and for what: said once at its end, with reasons.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/port.h"
#include "rt/command_guard.h"
#include "rt/rt_setup.h"
#include "rt/tick_stats.h"

namespace feedtwin::rt {

enum class Verdict : std::uint8_t {
  sound,                  ///< everything held
  not_valid_for_latency,  ///< the plant is right, but the host's timing was not: do not read latencies from this run
  unsound,                ///< the run's numbers are not to be used
};

[[nodiscard]] std::string_view name(Verdict verdict) noexcept;

/// What the verdict looks at.
struct RunFacts {
  bool timed = true;  ///< false: off line or in lockstep, where lateness has no meaning
  double tick_s = 1e-3;
  const TickStats* stats = nullptr;
  std::vector<SettingReport> settings;
  std::vector<GuardCounters> guards;
  std::vector<io::Counter> counters;
  double energy_balance_error = 0.0;
  bool finite = true;  ///< every state ended as a finite number
  std::uint64_t unwritten_rows = 0;
};

struct RunVerdict {
  Verdict verdict = Verdict::sound;
  std::vector<std::string> reasons;
};

/// Largest share of ticks missed with which the plant's own numbers are still used, and largest open energy balance.
inline constexpr double tolerated_missed_share = 0.05;
inline constexpr double tolerated_balance_error = 1e-3;

[[nodiscard]] RunVerdict judge(const RunFacts& facts);

}  // namespace feedtwin::rt
