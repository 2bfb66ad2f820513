#pragma once
// What a run's ticks were like, counted by the loop itself.

#include <cstdint>

#include "rt/latency_histogram.h"

namespace feedtwin::rt {

struct TickStats {
  std::uint64_t ticks = 0;
  std::uint64_t missed_ticks = 0;     ///< grid points passed over
  std::uint64_t late_starts = 0;      ///< ticks that began late because the one before ended late
  std::uint64_t dropped_records = 0;  ///< log rows that the writer was too slow for
  std::uint64_t dropped_events = 0;
  bool stopped_by_overrun = false;
  LatencyHistogram wakeup;     ///< from the grid point to the tick's begin, where the loop slept (as cyclictest counts)
  LatencyHistogram work;       ///< from the tick's begin to its end
  LatencyHistogram input_age;  ///< from a request's arrival to its first use
  LatencyHistogram reply;      ///< from the controller's trigger (SYNC) to the reply's leaving, where the port measures it
};

}  // namespace feedtwin::rt
