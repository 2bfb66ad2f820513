// Tables of what no hypothesis explains: what repeats over the travel is learned and simulated, what does not teaches
// nothing.

#include "tools/diagnose/learned.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/remainder.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Viscous friction that waves over the travel, which no effect of the catalogue is.
double washboard_Ns_per_m(double position_m) {
  return 120.0 * std::sin(2.0 * 3.141592653589793 * position_m / 0.009);
}

plant::EffectSetting washboard() {
  plant::EffectSetting table{"learned_residual", {}, {{}, {}, {}, {}, {}, {}, {}}};
  for (int i = -60; i <= 60; ++i) {
    const double at_m = 0.0005 * i;
    table.lists[0].push_back(at_m);
    for (const std::size_t force : {3U, 4U}) table.lists[force].push_back(0.0);
    table.lists[5].push_back(washboard_Ns_per_m(at_m));
    table.lists[6].push_back(-washboard_Ns_per_m(at_m));
  }
  return table;
}

TEST(Learned, AForceThatWavesOverTheTravelAndGrowsWithSpeed) {
  auto truth = plant::source_axis();
  truth.effects.push_back(washboard());
  const auto data = tests::short_case(truth, plant::source_axis());
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Learned table = learn_remainder(model, {data.axis, {}});
  EXPECT_GT(table.share_unseen, 0.5);
  EXPECT_EQ(table.axis, Where::position);
  ASSERT_EQ(table.damping_pos_Ns_per_m.size(), table.points.size());
  // forth and back differ in sign, and the numbers may take up a mean: what waves is told by differences
  double same = 0.0, size = 0.0, found = 0.0;
  for (std::size_t i = 8; i + 8 < table.points.size(); ++i) {  // away from where the motion turns
    const double there = washboard_Ns_per_m(table.points[i]);
    const double learned = 0.5 * (table.damping_pos_Ns_per_m[i] - table.damping_neg_Ns_per_m[i]);
    same += there * learned, size += there * there, found += learned * learned;
  }
  EXPECT_GT(same / std::sqrt(size * found), 0.9);
  EXPECT_NEAR(std::sqrt(found / size), 1.0, 0.35);

  auto extended = data.axis;
  extend(extended, table);
  const ForwardModel held_out(data.holdout, data);
  EXPECT_LT(held_out.nrmse(extended).at("torque_cmd_Nm"), 0.6 * held_out.nrmse(data.axis).at("torque_cmd_Nm"));
}

TEST(Learned, WhatActsAtOnePointOfTheTableIsToldWithAWidth) {
  auto truth = plant::source_axis();
  truth.effects.push_back(
      tests::effect("local_friction", {{"height_N", 15.0}, {"centre_m", 0.004}, {"half_width_m", 3e-4}, {"on_screw", 0.0}}));
  const auto data = tests::short_case(truth, plant::source_axis());
  const Learned table = learn_remainder(InverseModel(make_tracks(data.fit, data.axis), data.axis), {data.axis, {}});
  ASSERT_EQ(table.axis, Where::position);
  EXPECT_LT(table.low, 0.004);
  EXPECT_GT(table.high, 0.004);
  EXPECT_LT(table.high - table.low, 3.1 * (table.points[1] - table.points[0]));
  const auto is_midway = [&](double x) {  // of the way to the next point, where it would be a single one
    for (std::size_t i = 1; i < table.points.size(); ++i)
      if (std::abs(x - 0.5 * (table.points[i - 1] + table.points[i])) < 1e-12) return true;
    return false;
  };
  EXPECT_TRUE(is_midway(table.low) && is_midway(table.high)) << table.low << " to " << table.high;
}

// Slow runs hold of a mass no more than their noise; taken off from a fast one that was ten times what was left of it.
TEST(Learned, NumbersThatSlowRowsHardlyHoldAreNotTakenOffFromFastOnes) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto rows = [&](double acceleration_m_per_s2, double mass_kg) {
    Remainder some;
    for (int k = 0; k < 2000; ++k) {
      const double a = acceleration_m_per_s2 * noise(random);
      some.acceleration_m_per_s2.push_back(a);
      some.velocity_m_per_s.push_back(0.02 * noise(random));
      some.force_N.push_back(mass_kg * a + noise(random));
    }
    return some;
  };
  const auto rms_N = [](const Remainder& some) {
    return Eigen::Map<const Eigen::VectorXd>(some.force_N.data(), 2000).norm() / std::sqrt(2000.0);
  };
  Remainder slow = rows(0.002, 0.0), fast = rows(2.0, 0.0);
  take_off_numbers(slow, &fast);
  EXPECT_LT(rms_N(fast), 1.2);
  Remainder known = rows(2.0, 5.0), other = rows(2.0, 5.0);
  take_off_numbers(known, &other);
  EXPECT_LT(rms_N(other), 1.2) << "what as fast rows hold is";
}

TEST(Learned, ForcesOfAMomentTeachNothing) {
  auto data = tests::short_case(plant::source_axis(), plant::source_axis());
  std::mt19937_64 random(5);
  std::normal_distribution<double> unit;
  for (auto& run : data.fit) {
    double disturbance_Nm = 0.0;
    for (double& command : run.channels.at("torque_cmd_Nm")) {
      disturbance_Nm = 0.99 * disturbance_Nm + 0.0005 * unit(random);
      command += disturbance_Nm;
    }
  }
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Learned table = learn_remainder(model, {data.axis, {}});
  EXPECT_LT(table.share_unseen, 0.1);
  EXPECT_GT(table.remainder_N, 0.5);
}

}  // namespace
}  // namespace feedtwin
