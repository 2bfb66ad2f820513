#include "rt/latency_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace feedtwin::rt {
namespace {

TEST(LatencyHistogram, PercentilesAreThoseOfTheSortedRecordsWithinABucket) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 50; ++round) {
    std::lognormal_distribution<double> duration(6.0 + 0.2 * round, 0.2 + 0.05 * round);
    LatencyHistogram histogram;
    std::vector<std::int64_t> records(20000);
    for (auto& record : records) {
      record = static_cast<std::int64_t>(std::min(duration(random), 1.6e10));
      histogram.record(record);
    }
    std::ranges::sort(records);
    for (const double share : {0.5, 0.9, 0.99, 0.999, 0.9999, 1.0}) {
      const auto rank = static_cast<std::size_t>(std::ceil(share * 20000.0)) - 1;
      const double exact_us = static_cast<double>(records[rank]) * 1e-3;
      EXPECT_GE(histogram.percentile_us(share), exact_us * (1 - 1e-12)) << "round " << round << ", share " << share;
      EXPECT_LE(histogram.percentile_us(share), exact_us * (1.0 + 1.0 / 64) + 1e-3)
          << "round " << round << ", share " << share;
    }
    EXPECT_EQ(histogram.max_ns(), records.back());
    std::uint64_t counted = 0;
    double last_edge = -1.0;
    histogram.each([&](double edge, std::uint64_t count) {
      EXPECT_GT(edge, last_edge);
      last_edge = edge;
      counted += count;
    });
    EXPECT_EQ(counted, records.size());
  }
}

TEST(LatencyHistogram, TakesEveryInteger) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.percentile_us(0.5), 0.0);
  for (const std::int64_t value : {std::int64_t{-5}, std::int64_t{0}, INT64_MAX, INT64_MIN}) histogram.record(value);
  EXPECT_EQ(histogram.total(), 4U);
  EXPECT_EQ(histogram.percentile_us(0.5), 0.0);
}

}  // namespace
}  // namespace feedtwin::rt
