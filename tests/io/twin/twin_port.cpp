#include "io/twin/twin_port.h"

#include <gtest/gtest.h>

namespace feedtwin::io::twin {
namespace {

/// A loop of nothing: an axis whose counts follow the torque requested.
std::vector<double> torques_over(const TwinSettings& settings, int ticks, std::vector<Counter>* counters = nullptr) {
  std::uint32_t sequence = 0;
  TwinPort port(
      [&](const TickReport& tick, std::span<const AxisReport> axes, std::span<AxisRequest> requests) {
        EXPECT_EQ(axes.size(), 2U);
        for (AxisRequest& request : requests) {
          request.torque_Nm = 1e-3 * static_cast<double>(tick.tick);
          request.enable = true;
          request.sequence = sequence;
        }
        ++sequence;
        return true;
      },
      settings, {.axes = 2, .axis = {}});
  std::vector<double> used;
  std::array<AxisRequest, 2> newest{};
  std::array<AxisReport, 2> reports{};
  for (int tick = 0; tick < ticks; ++tick) {
    port.send({.tick = static_cast<std::uint64_t>(tick), .missed_ticks = 0, .start_ns = tick * 1'000'000}, reports);
    const auto fresh = port.receive(newest);
    EXPECT_TRUE(fresh == 0 || fresh == 3) << fresh;
    used.push_back(newest[0].torque_Nm);
  }
  if (counters != nullptr) *counters = port.counters();
  return used;
}

TEST(TwinPort, WithoutFaultsTheAnswerIsThereInTheNextTick) {
  const auto used = torques_over({}, 100);
  for (std::size_t tick = 0; tick < used.size(); ++tick) ASSERT_DOUBLE_EQ(used[tick], 1e-3 * static_cast<double>(tick));
}

TEST(TwinPort, DelaysOfBothWaysAddUp) {
  TwinSettings settings;
  settings.to_controller.delay_ticks = 2;
  settings.to_plant.delay_ticks = 3;
  const auto used = torques_over(settings, 100);
  for (std::size_t tick = 5; tick < used.size(); ++tick) ASSERT_DOUBLE_EQ(used[tick], 1e-3 * static_cast<double>(tick - 5));
}

TEST(TwinPort, FaultsComeFromTheSeedAlone) {
  TwinSettings settings;
  settings.to_controller = {.loss = 0.1, .duplicate = 0.05, .delay_ticks = 1, .jitter_ticks = 3};
  settings.to_plant = settings.to_controller;
  std::vector<Counter> counters;
  const auto used = torques_over(settings, 2000, &counters);
  EXPECT_EQ(used, torques_over(settings, 2000));
  settings.seed = 2;
  EXPECT_NE(used, torques_over(settings, 2000));
  for (const Counter& counter : counters) EXPECT_GT(counter.value, 0U) << counter.name;
}

}  // namespace
}  // namespace feedtwin::io::twin
