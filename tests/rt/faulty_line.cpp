// The loop at the end of a line that loses, repeats and reorders: old commands never act, silence takes the torque away.
#include <gtest/gtest.h>

#include <atomic>

#include "io/twin/twin_port.h"
#include "plant/parameter_table.h"
#include "rt/plant_loop.h"

namespace feedtwin::rt {
namespace {

constexpr std::int64_t tick_ns = 1'000'000;

struct Outcome {
  GuardCounters counters;
  bool went_back = false;             ///< a command acted after a newer one
  std::int64_t oldest_acting_ns = 0;  ///< age of the oldest command that still had torque
};

Outcome run(const io::twin::TwinSettings& settings, std::int64_t watchdog_ns, std::uint32_t silent_from,
            std::uint64_t ticks) {
  Outcome outcome;
  std::uint32_t sequence = 0, seen = 0;
  std::vector<plant::FeedAxis> axes;
  axes.emplace_back(plant::source_axis());
  io::twin::TwinPort port(
      [&](const io::TickReport&, std::span<const io::AxisReport>, std::span<io::AxisRequest> requests) {
        if (sequence >= silent_from) return false;
        requests[0].torque_Nm = 0.2;
        requests[0].enable = true;
        requests[0].sequence = ++sequence;
        return true;
      },
      settings, {});
  // a second port sees every report as it leaves the loop
  io::twin::TwinPort watcher(
      [&](const io::TickReport&, std::span<const io::AxisReport> reports, std::span<io::AxisRequest>) {
        outcome.went_back = outcome.went_back || reports[0].sequence < seen;
        seen = reports[0].sequence;
        if (reports[0].state == io::DriveState::enabled)
          outcome.oldest_acting_ns = std::max(outcome.oldest_acting_ns, reports[0].input_age_ns);
        return false;
      },
      {}, {});
  OfflineClock clock(tick_ns);
  PlantLoop loop(axes, port, {&watcher}, clock, {.ticks = ticks, .watchdog_ns = watchdog_ns});
  const std::atomic<bool> stop{false};
  loop.run(stop);
  outcome.counters = loop.guard(0).counters();
  EXPECT_EQ(loop.stats().ticks, ticks);
  return outcome;
}

TEST(FaultyLine, OldCommandsNeverActWhateverTheLineDoes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    io::twin::TwinSettings settings;
    settings.seed = seed;
    settings.to_controller = {.loss = 0.1, .duplicate = 0.05, .delay_ticks = 1, .jitter_ticks = 2};
    settings.to_plant = {.loss = 0.15, .duplicate = 0.1, .delay_ticks = 1, .jitter_ticks = 5};
    const Outcome outcome = run(settings, 50 * tick_ns, 1'000'000, 3000);
    EXPECT_FALSE(outcome.went_back) << "seed " << seed;
    EXPECT_GT(outcome.counters.reordered, 100U) << "seed " << seed;
    EXPECT_GT(outcome.counters.lost, 100U) << "seed " << seed;
    EXPECT_GT(outcome.counters.held, 100U) << "seed " << seed;
    EXPECT_EQ(outcome.counters.watchdog, 0U) << "seed " << seed;
  }
}

TEST(FaultyLine, SilenceTakesTheTorqueAwayAtTheWatchdogTime) {
  const Outcome outcome = run({}, 20 * tick_ns, 100, 500);
  EXPECT_EQ(outcome.counters.watchdog, 1U);
  EXPECT_EQ(outcome.oldest_acting_ns, 20 * tick_ns);
}

}  // namespace
}  // namespace feedtwin::rt
