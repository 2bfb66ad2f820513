#include "io/gpio/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "io/gpio/edge_player.h"
#include "io/gpio/gpio_port.h"
#include "io/gpio/twin_lines.h"
#include "io/monotonic.h"

namespace feedtwin::io::gpio {
namespace {

constexpr std::int64_t tick_ns = 1'000'000, spacing_ns = 10'000;

/// A player on twin lines in a time of its own, with a decoder on each axis.
struct Bench {
  explicit Bench(std::vector<EdgeAxis> axes)
      : lines([this](std::uint64_t levels) {
          for (std::size_t i = 0; i < decoders.size(); ++i) {
            const auto own = static_cast<std::uint8_t>(levels >> (3 * i) & 7U);
            if (own != seen[i]) changes[i].push_back(now_ns);
            seen[i] = own;
            decoders[i].see(own);
          }
        }),
        player(lines, axes, tick_ns, spacing_ns),
        changes(axes.size()) {
    for (const auto& axis : axes) {
      seen.push_back(levels_at(axis.start_count, axis.counts_per_rev));
      decoders.emplace_back(seen.back());
    }
    player.open();
  }
  void tick(std::size_t axis, std::int64_t counts) { player.aim(axis, counts, now_ns); }
  void run() {
    const std::int64_t end_ns = now_ns + tick_ns;
    for (std::int64_t next = player.next_ns(); next < end_ns; next = player.next_ns()) {
      now_ns = std::max(now_ns, next);
      player.play(now_ns);
    }
    now_ns = end_ns;
  }

  std::int64_t now_ns = 1'000'000'000;
  std::vector<std::uint8_t> seen;
  std::vector<QuadratureDecoder> decoders;
  TwinLines lines;
  EdgePlayer player;
  std::vector<std::vector<std::int64_t>> changes;
};

TEST(Quadrature, LevelsFollowTheGrayCycleAndTheIndexIsOneStateWide) {
  for (std::int64_t count = -1000; count <= 1000; ++count) {
    const auto at = levels_at(count, 100), next = levels_at(count + 1, 100);
    const int changed = (at ^ next) & (line_a | line_b);
    EXPECT_TRUE(changed == line_a || changed == line_b) << count;
    EXPECT_EQ((at & line_z) != 0, count % 100 == 0) << count;
  }
  EXPECT_EQ(levels_at(0, 100) & 3, 0);
  EXPECT_EQ(levels_at(1, 100) & 3, line_a);  // A leads
  EXPECT_EQ(levels_at(2, 100) & 3, line_a | line_b);
  EXPECT_EQ(levels_at(3, 100) & 3, line_b);
}

TEST(Quadrature, EveryCountComesBackThroughReversals) {
  constexpr std::int64_t rev = 400;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    Bench bench({{rev, 0}, {rev, 137}});
    std::vector<std::int64_t> at{0, 137};
    std::uint64_t indices = 0;
    for (int i = 0; i < 2000; ++i) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::int64_t to = at[axis] + static_cast<std::int64_t>(random() % 181) - 90;  // below 100 a tick
        if (axis == 0) {
          for (std::int64_t c = at[0]; c != to;) {
            c += to > c ? 1 : -1;
            indices += c % rev == 0 ? 1U : 0U;
          }
        }
        at[axis] = to;
        bench.tick(axis, to);
      }
      bench.run();
      ASSERT_EQ(bench.decoders[0].count(), at[0]) << "seed " << seed << " tick " << i;
      ASSERT_EQ(bench.decoders[1].count() + 137, at[1]) << "seed " << seed << " tick " << i;
    }
    EXPECT_EQ(bench.decoders[0].illegal() + bench.decoders[1].illegal(), 0U);
    EXPECT_EQ(bench.decoders[0].indices(), indices) << seed;
    EXPECT_EQ(bench.player.schedules()[0].overspeed_ticks(), 0U);
  }
}

TEST(Quadrature, EdgesAreSpreadAndNeverCloserThanStated) {
  Bench bench({{65536, 0}});
  std::int64_t at = 0;
  for (int i = 0; i < 1000; ++i) {
    at += i % 60;
    bench.tick(0, at);
    bench.run();
  }
  const auto& times = bench.changes[0];
  for (std::size_t i = 1; i < times.size(); ++i) ASSERT_GE(times[i] - times[i - 1], spacing_ns) << i;
  // at a steady 50 a tick: one every 20 us
  Bench steady({{65536, 0}});
  for (int i = 1; i <= 100; ++i) {
    steady.tick(0, 50 * i);
    steady.run();
  }
  for (std::size_t i = 1; i < steady.changes[0].size(); ++i) {
    ASSERT_EQ(steady.changes[0][i] - steady.changes[0][i - 1], 20'000) << i;
  }
}

TEST(Quadrature, AboveTheRateNothingIsDroppedAndItIsCounted) {
  Bench bench({{65536, 0}});
  std::int64_t at = 0;
  for (int i = 0; i < 10; ++i) {
    at += 250;  // 100 fit
    bench.tick(0, at);
    bench.run();
  }
  EXPECT_EQ(bench.player.schedules()[0].overspeed_ticks(), 10U);
  EXPECT_LT(bench.decoders[0].count(), at);
  for (int i = 0; i < 30; ++i) {
    bench.tick(0, at);
    bench.run();
  }
  EXPECT_EQ(bench.decoders[0].count(), at);
  EXPECT_EQ(bench.decoders[0].illegal(), 0U);
  EXPECT_GT(bench.player.schedules()[0].most_behind(), 1000);
}

TEST(Quadrature, FaultsOfTheLines) {
  const auto after = [](const LineFaults& faults, int counts) {
    Bench bench({{400, 0}});
    bench.player.set_faults(0, faults);
    for (int i = 1; i <= std::abs(counts) / 50; ++i) {
      bench.tick(0, (counts > 0 ? 50 : -50) * i);
      bench.run();
    }
    return bench.decoders[0];
  };
  EXPECT_EQ(after({.swapped_ab = true}, 1000).count(), -1000);
  EXPECT_EQ(after({.swapped_ab = true}, -1000).count(), 1000);
  EXPECT_LE(std::abs(after({.dead_a = true}, 1000).count()), 1);
  EXPECT_LE(std::abs(after({.dead_b = true}, 1000).count()), 1);
  EXPECT_EQ(after({.missing_index = true}, 1000).indices(), 0U);
  EXPECT_EQ(after({}, 1000).indices(), 2U);
  EXPECT_EQ(after({.missing_index = true}, 1000).count(), 1000);
  EXPECT_EQ(after({.lost_counts = 7}, 1000).count(), 1000 - 7);
}

TEST(GpioPort, TheEdgeThreadPutsOutEveryCount) {
  std::atomic<std::int64_t> count{0};
  std::atomic<std::uint64_t> illegal{0};
  QuadratureDecoder decoder(levels_at(0, 400));
  auto lines = std::make_unique<TwinLines>([&](std::uint64_t levels) {  // on the edge thread
    decoder.see(static_cast<std::uint8_t>(levels & 7U));
    count.store(decoder.count());
    illegal.store(decoder.illegal());
  });
  GpioSettings settings;
  settings.axes = {{400, 0}};
  settings.priority = 0;
  GpioPort port(std::move(lines), settings);
  port.open();
  std::vector<AxisReport> report(1);
  port.send({}, report);
  const auto wait_for = [&](std::int64_t wanted) {
    for (int i = 0; i < 10000 && count.load() != wanted; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_EQ(count.load(), wanted);
  };
  std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the first report places, it does not move
  for (const std::int64_t to : {40, 80, 60, -20, -500, 3}) {
    report[0].encoder_counts = to;
    port.send({}, report);
    wait_for(to);
  }
  port.close();
  EXPECT_EQ(illegal.load(), 0U);
  std::uint64_t edges = 0;
  for (const auto& counter : port.counters()) {
    if (counter.name == "edges") edges = counter.value;
  }
  EXPECT_EQ(edges, 40U + 40 + 20 + 80 + 480 + 503);
}

}  // namespace
}  // namespace feedtwin::io::gpio
