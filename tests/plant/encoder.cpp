#include "plant/encoder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace feedtwin::plant {
namespace {

TEST(Encoder, IndexPassesOnceARevolutionInBothDirections) {
  const Encoder encoder(0.005, 1000);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> step(-37, 37);
  std::int64_t at = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::int64_t to = at + step(random);
    // the index state is count 0 of a revolution: passed if any count after `at`, up to `to`, is one
    bool passed = false;
    for (std::int64_t c = at; c != to;) {
      c += to > at ? 1 : -1;
      passed = passed || c % 1000 == 0;
    }
    ASSERT_EQ(encoder.index_between(at, to), passed) << at << " -> " << to;
    at = to;
  }
}

TEST(Encoder, AnAxisThatRanAwayShowsTheFarthestCount) {
  const Encoder encoder(0.005, 65536.0);
  EXPECT_EQ(encoder.counts(1e30), 4'000'000'000'000'000'000);
  EXPECT_EQ(encoder.counts(-1e30), -4'000'000'000'000'000'000);
  EXPECT_EQ(encoder.counts(1e30) - encoder.counts(-1e30), 8'000'000'000'000'000'000);
}

TEST(Encoder, CountsAreWithinHalfACountOfThePosition) {
  const Encoder encoder(0.005, 65536);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> position(-0.1, 0.1);
  for (int i = 0; i < 100000; ++i) {
    const double x = position(random);
    ASSERT_LE(std::abs(encoder.position_m(encoder.counts(x)) - x), 0.5 * encoder.resolution_m() * (1 + 1e-9)) << x;
  }
}

}  // namespace
}  // namespace feedtwin::plant
