#include "io/twin/line.h"

#include <gtest/gtest.h>

#include <map>

namespace feedtwin::io::twin {
namespace {

/// What arrives, and when, of one message a tick.
std::multimap<std::uint64_t, int> sent_over(Line<int>& line, int messages) {
  std::multimap<std::uint64_t, int> arrived;
  for (std::uint64_t tick = 0; tick < static_cast<std::uint64_t>(messages) + 100; ++tick) {
    if (tick < static_cast<std::uint64_t>(messages)) line.send(static_cast<int>(tick), tick);
    while (const int* message = line.receive(tick)) arrived.emplace(tick, *message);
  }
  return arrived;
}

TEST(TwinLine, AGoodLineGivesEveryMessageAtOnceAndInOrder) {
  Line<int> line({}, 1, 4, 0);
  const auto arrived = sent_over(line, 1000);
  ASSERT_EQ(arrived.size(), 1000U);
  for (const auto& [tick, message] : arrived) ASSERT_EQ(tick, static_cast<std::uint64_t>(message));
}

TEST(TwinLine, DelayIsWithinItsBoundsAndReorders) {
  Line<int> line({.delay_ticks = 3, .jitter_ticks = 4}, 1, 32, 0);
  const auto arrived = sent_over(line, 5000);
  ASSERT_EQ(arrived.size(), 5000U);
  int last = -1, overtaken = 0;
  std::map<std::uint64_t, int> delays;
  for (const auto& [tick, message] : arrived) {
    ++delays[tick - static_cast<std::uint64_t>(message)];
    overtaken += message < last;
    last = message;
  }
  EXPECT_GT(overtaken, 500);
  ASSERT_EQ(delays.size(), 5U);
  for (const auto& [delay, count] : delays) {
    EXPECT_GE(delay, 3U);
    EXPECT_LE(delay, 7U);
    EXPECT_NEAR(count, 1000, 130) << delay;
  }
}

TEST(TwinLine, LossAndDuplicationAreCountedAndNearWhatWasAsked) {
  Line<int> line({.loss = 0.2, .duplicate = 0.1}, 7, 8, 0);
  const auto arrived = sent_over(line, 10000);
  EXPECT_EQ(arrived.size(), 10000 - line.lost() + line.duplicated());
  EXPECT_NEAR(static_cast<double>(line.lost()), 2000.0, 200.0);
  EXPECT_NEAR(static_cast<double>(line.duplicated()), 1000.0, 150.0);
}

TEST(TwinLine, TheSameSeedIsTheSameLine) {
  const LineFaults faults{.loss = 0.1, .duplicate = 0.1, .delay_ticks = 1, .jitter_ticks = 5};
  Line<int> a(faults, 3, 64, 0), b(faults, 3, 64, 0), c(faults, 4, 64, 0);
  const auto from_a = sent_over(a, 1000);
  EXPECT_EQ(from_a, sent_over(b, 1000));
  EXPECT_NE(from_a, sent_over(c, 1000));
}

TEST(TwinLine, AFullLineLosesAndSaysSo) {
  Line<int> line({.delay_ticks = 10}, 1, 4, 0);
  const auto arrived = sent_over(line, 100);
  EXPECT_GT(line.lost(), 0U);
  EXPECT_EQ(arrived.size() + line.lost(), 100U);
}

}  // namespace
}  // namespace feedtwin::io::twin
