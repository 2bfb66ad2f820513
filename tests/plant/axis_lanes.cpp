#include "plant/axis_lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "plant/integrator.h"
#include "tests/support/random_axis.h"

namespace feedtwin::plant {
namespace {

constexpr std::size_t lanes = 8;
using Octet = Doubles<lanes>;

// The lanes differ in everything: parameters, motion, when they stick and reverse, which of them lies at an end stop.
TEST(AxisLanes, EightAxesAtOnceMoveAsEachDoesAlone) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    AxisModel<Octet> model;
    AxisState<Octet> state{};
    std::array<AxisModel<double>, lanes> models;
    std::array<AxisState<double>, lanes> states{};
    std::array<double, lanes> amplitude_N, rate_rad_per_s;
    for (std::size_t i = 0; i < lanes; ++i) {
      models[i] = make_axis_model(tests::axis_near_source(random, 2.0));
      set_lane(model, i, models[i]);
      amplitude_N[i] = 50.0 + 800.0 * unit(random);
      rate_rad_per_s[i] = 10.0 + 60.0 * unit(random);
      states[i].position_m = i == 3 ? 0.0749 : 0.0;
      states[i].velocity_m_per_s = i % 2 == 0 ? 0.0 : 0.1 * unit(random);
      set_lane(state, i, states[i]);
    }
    NoEffects<Octet> no_effects;
    NoEffects<double> no_effect;
    int at_rest = 0, moving = 0, mixed = 0;
    for (int tick = 0; tick < 1000; ++tick) {
      Octet drive;
      for (std::size_t i = 0; i < lanes; ++i) drive[i] = amplitude_N[i] * std::sin(rate_rad_per_s[i] * 1e-3 * tick);
      const auto losses = integrate_tick<Octet>(model, state, no_effects, drive, 1e-3, one_count);
      int rests = 0;
      for (std::size_t i = 0; i < lanes; ++i) {
        const auto alone = integrate_tick<double>(models[i], states[i], no_effect, drive[i], 1e-3, one_count);
        const auto together = lane_of(state, i);
        const auto lost = lane_of(losses, i);
        SCOPED_TRACE(testing::Message() << "round " << round << " tick " << tick << " lane " << i);
        ASSERT_NEAR(together.position_m, states[i].position_m, 1e-9 * 0.01);
        ASSERT_NEAR(together.velocity_m_per_s, states[i].velocity_m_per_s, 1e-9);
        ASSERT_NEAR(together.screw_bristle_m, states[i].screw_bristle_m, 1e-9 * 1e-6);
        ASSERT_NEAR(together.guide_bristle_m, states[i].guide_bristle_m, 1e-9 * 1e-5);
        ASSERT_NEAR(lost.motor_J, alone.motor_J, 1e-9 * 0.1);
        ASSERT_NEAR(lost.screw_J, alone.screw_J, 1e-9 * 0.1);
        ASSERT_NEAR(lost.guide_J, alone.guide_J, 1e-9 * 0.1);
        ASSERT_NEAR(lost.stop_J, alone.stop_J, 1e-9 * 0.1);
        ASSERT_NEAR(lost.travel_pos_m, alone.travel_pos_m, 1e-9 * 0.01);
        ASSERT_NEAR(lost.speed_travel_neg_m2_per_s, alone.speed_travel_neg_m2_per_s, 1e-9 * 0.01);
        rests += together.velocity_m_per_s == 0.0;
      }
      at_rest += rests == lanes;
      moving += rests == 0;
      mixed += rests > 0 && rests < static_cast<int>(lanes);
    }
    EXPECT_GT(mixed, 10) << "round " << round << ": nothing tested: at rest " << at_rest << ", moving " << moving;
  }
}

}  // namespace
}  // namespace feedtwin::plant
