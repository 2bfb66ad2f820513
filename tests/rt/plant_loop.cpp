#include "rt/plant_loop.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "plant/parameter_table.h"
#include "tests/support/allocation_guard.h"

namespace feedtwin::rt {
namespace {

/// A scripted peer: a sinusoidal torque with whatever goes wrong on purpose.
class ScriptedPort final : public io::Port {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "scripted"; }
  void open() override {}
  void close() noexcept override {}
  std::uint64_t receive(std::span<io::AxisRequest> newest) noexcept FEEDTWIN_REALTIME override {
    if (silent) return 0;
    for (auto& request : newest) {
      request.torque_Nm = amplitude_Nm * std::sin(0.01 * static_cast<double>(tick_));
      request.sequence = static_cast<std::uint32_t>(tick_);
      request.arrival_ns = now_ns_;
      request.enable = true;
      request.quick_stop = quick_stop;
    }
    return (std::uint64_t{1} << newest.size()) - 1;
  }
  void send(const io::TickReport& tick, std::span<const io::AxisReport> axes) noexcept FEEDTWIN_REALTIME override {
    ++tick_;
    ++reports;
    now_ns_ = tick.start_ns;
    last = axes[0];
  }
  bool silent = false, quick_stop = false;
  double amplitude_Nm = 0.4;
  std::uint64_t reports = 0;
  io::AxisReport last;

 private:
  std::uint64_t tick_ = 0;
  std::int64_t now_ns_ = 0;
};

struct Bench {
  explicit Bench(std::size_t count, LoopSettings settings = {}) {
    for (std::size_t i = 0; i < count; ++i) axes.emplace_back(plant::source_axis());
    loop = std::make_unique<PlantLoop>(axes, port, std::vector<io::Port*>{&listener}, clock, settings);
  }
  void run(std::uint64_t ticks) { loop->run_to(loop->stats().ticks + ticks, stop); }
  std::vector<plant::FeedAxis> axes;
  ScriptedPort port, listener;
  OfflineClock clock{1'000'000};
  std::atomic<bool> stop{false};
  std::unique_ptr<PlantLoop> loop;
};

TEST(PlantLoop, AQuickStopBrakesAndThenLeavesTheAxisAlone) {
  Bench bench(1);
  bench.run(200);
  ASSERT_GT(std::abs(bench.port.last.velocity_m_per_s), 0.01);
  bench.port.quick_stop = true;
  bench.run(1);
  EXPECT_EQ(bench.port.last.state, io::DriveState::quick_stop);
  EXPECT_LT(bench.port.last.torque_Nm * bench.port.last.velocity_m_per_s, 0.0);
  bench.run(200);
  EXPECT_EQ(bench.port.last.ticks_done, 401U);
  EXPECT_LT(std::abs(bench.port.last.velocity_m_per_s), 1e-6);
  EXPECT_LT(std::abs(bench.port.last.torque_Nm), 1e-3);
  bench.port.quick_stop = false;
  bench.run(10);
  EXPECT_EQ(bench.port.last.state, io::DriveState::enabled);
}

TEST(PlantLoop, TheTickDoesNotAllocate) {
  Bench bench(3);
  bench.run(10);
  std::uint64_t allocations = 0;
  {
    const test::AllocationGuard guard;
    bench.run(25000);  // longer than the log's ring: the full ring is part of it
    allocations = guard.allocations();
  }
  EXPECT_EQ(allocations, 0U);
  EXPECT_GT(bench.loop->stats().dropped_records, 0U);
  const test::AllocationGuard guard;
  void* const memory = ::operator new(16);
  EXPECT_EQ(guard.allocations(), 1U) << "the guard itself sees an allocation";
  ::operator delete(memory);
}

#if defined(__has_feature)
#if __has_feature(realtime_sanitizer)
/// A port that does what no port may do in a tick.
class BlockingPort final : public io::Port {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "blocking"; }
  void open() override {}
  void close() noexcept override {}
  std::uint64_t receive(std::span<io::AxisRequest>) noexcept FEEDTWIN_REALTIME override { return 0; }
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wfunction-effects"
  void send(const io::TickReport&, std::span<const io::AxisReport>) noexcept FEEDTWIN_REALTIME override {
    ::operator delete(::operator new(16));
  }
#pragma clang diagnostic pop
};

TEST(PlantLoopDeathTest, RealtimeSanitizerSeesAPortThatAllocatesInTheTick) {
  std::vector<plant::FeedAxis> axes;
  axes.emplace_back(plant::source_axis());
  BlockingPort port;
  OfflineClock clock(1'000'000);
  const std::atomic<bool> stop{false};
  EXPECT_DEATH(
      {
        PlantLoop loop(axes, port, {}, clock, {});
        loop.run_to(2, stop);
      },
      "unsafe-library-call|RealtimeSanitizer");
}
#endif
#endif

TEST(PlantLoop, EveryTickIsARowAndEveryPortGetsEveryReport) {
  Bench bench(2);
  std::array<AxisRecord, 4096> rows{};
  std::uint64_t expected_tick = 0;
  for (int piece = 0; piece < 5; ++piece) {
    bench.run(1000);
    const std::size_t count = bench.loop->records().pop(rows);
    ASSERT_EQ(count, 2000U);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(rows[i].axis, static_cast<std::int32_t>(i % 2));
      ASSERT_EQ(rows[i].tick, expected_tick + i / 2);
    }
    expected_tick += 1000;
  }
  EXPECT_EQ(bench.loop->stats().ticks, 5000U);
  EXPECT_EQ(bench.port.reports, 5001U) << "one before the first tick, then one a tick";
  EXPECT_EQ(bench.listener.reports, 5000U);
  EXPECT_EQ(bench.loop->stats().dropped_records, 0U);
}

TEST(PlantLoop, ARowHoldsWhatWasMeasuredBeforeItsCommandActed) {
  Bench bench(1);
  plant::FeedAxis twin(plant::source_axis());
  std::array<AxisRecord, 1000> rows{};
  bench.run(1000);
  ASSERT_EQ(bench.loop->records().pop(rows), 1000U);
  for (const auto& row : rows) {
    ASSERT_EQ(row.encoder_counts, twin.signals().encoder_counts) << "tick " << row.tick;
    const plant::AxisCommand command{.torque_Nm = row.torque_command_Nm};
    ASSERT_EQ(row.torque_sensor_Nm, twin.force_sensors(command).torque_sensor_Nm) << "tick " << row.tick;
    twin.step(command, 1e-3);
  }
  EXPECT_NE(twin.signals().encoder_counts, 0) << "the axis never moved";
}

TEST(PlantLoop, ASilentControllerLosesItsTorqueWithinTheWatchdogTime) {
  Bench bench(1, {.watchdog_ns = 20'000'000});
  bench.run(200);
  bench.port.silent = true;
  std::array<AxisRecord, 2048> rows{};
  bench.loop->records().pop(rows);
  bench.run(100);
  const std::size_t count = bench.loop->records().pop(rows);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 21) {
      ASSERT_EQ(rows[i].torque_command_Nm, 0.0) << i << " ms after the last command";
      ASSERT_EQ(rows[i].state, io::DriveState::fault);
    }
  }
  EXPECT_NE(rows[5].torque_command_Nm, 0.0);
  EXPECT_EQ(bench.loop->guard(0).counters().watchdog, 1U);
  bench.run(3000);
  EXPECT_EQ(bench.port.last.velocity_m_per_s, 0.0) << "friction brings the axis to rest";
}

TEST(PlantLoop, TheSameRunTwiceIsTheSameToTheLastBit) {
  Bench first(1), second(1);
  first.run(5000);
  second.run(1234);
  second.run(5000 - 1234);
  EXPECT_EQ(first.axes[0].state().position_m, second.axes[0].state().position_m);
  EXPECT_EQ(first.axes[0].energy().lost_J, second.axes[0].energy().lost_J);
}

TEST(PlantLoop, EndStopsAreAnEventNotAFlood) {
  Bench bench(1);
  bench.port.amplitude_Nm = 1.9;
  bench.run(3000);
  std::array<Event, 256> events{};
  const std::size_t count = bench.loop->events().pop(events);
  int stops = 0;
  for (std::size_t i = 0; i < count; ++i) stops += events[i].kind == EventKind::end_stop ? 1 : 0;
  EXPECT_GE(stops, 1);
  EXPECT_LE(stops, 40);
  EXPECT_LT(std::abs(bench.axes[0].state().position_m), 0.076);
}

}  // namespace
}  // namespace feedtwin::rt
