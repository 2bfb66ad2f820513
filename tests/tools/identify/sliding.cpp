// Where friction is that of sliding: neither at rest, nor just after a rest or a reversal.

#include "tools/identify/sliding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace feedtwin {
namespace {

constexpr double sample_s = 1e-3, count_m = 0.005 / 65536.0;

/// Positions on the encoder's grid under a velocity, row by row.
std::vector<double> shown(const std::vector<double>& velocity_m_per_s) {
  std::vector<double> position_m{0.0};
  double x = 0.0;
  for (const double v : velocity_m_per_s) position_m.push_back(std::floor((x += v * sample_s) / count_m) * count_m);
  return position_m;
}

TEST(Sliding, IsNeitherRestNorWhatFollowsIt) {
  std::vector<double> velocity(500, 0.0);
  velocity.resize(1000, 0.02);
  velocity.resize(1500, -0.02);
  const auto slides = tools::rows_of_surely_sliding(shown(velocity), sample_s);
  for (const std::size_t k : {10U, 250U, 490U, 505U, 520U, 995U, 1005U, 1020U}) EXPECT_FALSE(slides[k]) << k;
  for (const std::size_t k : {560U, 700U, 980U, 1060U, 1400U}) EXPECT_TRUE(slides[k]) << k;
}

TEST(Sliding, CreepSlidesOnlyAfterItsPresliding) {
  std::vector<double> velocity(100, 0.0);
  velocity.resize(1100, 5e-4);  // 50 um take a tenth of a second
  const auto slides = tools::rows_of_surely_sliding(shown(velocity), sample_s);
  EXPECT_FALSE(slides[180]);
  EXPECT_TRUE(slides[250]);
}

/// Of any motion: no row slides that is near standstill, and stretches are runs of rows that do, none too short.
TEST(Sliding, StretchesHoldRowsThatSlideAndLeaveOutShortOnes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    const double amplitude = 0.1 * uniform(random), hertz = 0.3 + 3.0 * uniform(random), phase = uniform(random);
    std::vector<double> velocity;
    for (int k = 0; k < 4000; ++k)
      velocity.push_back(amplitude * std::sin(2.0 * std::numbers::pi * (hertz * k * sample_s + phase)));
    const auto slides = tools::rows_of_surely_sliding(shown(velocity), sample_s);
    std::size_t within = 0;
    for (const auto& [first, end] : tools::stretches_of(slides)) {
      EXPECT_GE(end - first, 50U);
      EXPECT_TRUE(first == 0 || !slides[first - 1]);
      EXPECT_TRUE(end == slides.size() || !slides[end]);
      for (std::size_t k = first; k < end; ++k) {
        EXPECT_TRUE(slides[k]);
        EXPECT_GT(std::abs(velocity[std::min<std::size_t>(k, 3999)]), 0.5 * tools::standstill_m_per_s);
      }
      within += end - first;
    }
    EXPECT_LE(within, slides.size());
  }
}

}  // namespace
}  // namespace feedtwin
