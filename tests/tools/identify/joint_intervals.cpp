#include "tools/identify/joint_intervals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tools/intervals.h"

namespace feedtwin::tools {
namespace {

constexpr double known = std::numeric_limits<double>::infinity();

TEST(JointIntervals, OneAloneIsTheUsualInterval) {
  EXPECT_NEAR(joint_90(1, known), normal_90, 1e-12);
  // Student's t, 0.95 quantile: tables
  EXPECT_NEAR(joint_90(1, 10.0), 1.8124611, 1e-5);
  EXPECT_NEAR(joint_90(1, 30.0), 1.6972609, 1e-6);
}

/// Share of draws in which none of `count` scores is beyond the half-width. @param common share of each score's variance
/// that all have in common; @param draws that each score's deviation is seen in; 0: known
double share_held(std::size_t count, double common, int draws) {
  constexpr int repeats = 20000;
  std::mt19937_64 random(51);
  std::normal_distribution<double> unit;
  std::chi_squared_distribution<double> squares(draws > 0 ? draws : 1);
  const double half = joint_90(count, draws > 0 ? draws : known);
  int held = 0;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double shared = std::sqrt(common) * unit(random);
    double furthest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double score = shared + std::sqrt(1.0 - common) * unit(random);
      const double deviation = draws > 0 ? std::sqrt(squares(random) / draws) : 1.0;
      furthest = std::max(furthest, std::abs(score) / deviation);
    }
    held += furthest <= half ? 1 : 0;
  }
  return static_cast<double>(held) / repeats;
}

// 0.007 is three deviations of a share of 20000.
TEST(JointIntervals, HoldAllAtOnceInNineOfTen) {
  for (const std::size_t count : {2U, 8U, 32U}) {
    EXPECT_NEAR(share_held(count, 0.0, 0), 0.9, 0.007) << count << " independent";
    EXPECT_NEAR(share_held(count, 0.0, 32), 0.9, 0.007) << count << " whose deviations come from 32 draws each";
    EXPECT_GT(share_held(count, 0.5, 0), 0.893) << count << " correlated";
  }
  EXPECT_GT(share_held(32, 0.99, 0), 0.95) << "almost one";
}

TEST(JointIntervals, APartSeenInDrawsMakesThemWider) {
  EXPECT_EQ(degrees_of_freedom(4.0, 0.0, 32), known);
  EXPECT_DOUBLE_EQ(degrees_of_freedom(4.0, 4.0, 32), 32.0) << "all of it";
  EXPECT_DOUBLE_EQ(degrees_of_freedom(4.0, 2.0, 32), 128.0);
  EXPECT_GT(joint_90(32, 32.0), joint_90(32, 128.0));
  EXPECT_GT(joint_90(32, 128.0), joint_90(32, known));
}

}  // namespace
}  // namespace feedtwin::tools
