// Learned tables of channels: shown beside what the axis does, and never changing it; learned tables of the command: acting.
#include <gtest/gtest.h>

#include <cmath>

#include "plant/feed_axis.h"
#include "plant/parameter_table.h"
#include "tests/support/tick.h"

namespace feedtwin::plant {
namespace {

using test::tick_s;

FeedAxis axis_with_table(EffectSetting table) {
  auto axis = source_axis();
  axis.effects.push_back(std::move(table));
  return FeedAxis(axis);
}

double torque_at(int tick) {
  return 0.4 * std::sin(0.01 * tick);
}

/// Calls told(with, without, command, time) after each tick of the same commands to an axis with and one without the table.
template <class F>
void side_by_side(EffectSetting table, const F& told) {
  FeedAxis with = axis_with_table(std::move(table)), without{source_axis()};
  for (int tick = 0; tick < 1500; ++tick) {
    const AxisCommand command{.torque_Nm = torque_at(tick)};
    (void)with.step(command, tick_s), (void)without.step(command, tick_s);
    told(with, without, command, (tick + 1) * tick_s);
  }
}

TEST(LearnedTables, ATorqueSensorShowsItsTableOfWhatIsThere) {
  side_by_side({"learned_reading", {0.0}, {{}, {}, {-10.0, 10.0}, {}, {-2.0, 2.0}, {}, {}, {}}},
               [](const FeedAxis& with, const FeedAxis& without, const AxisCommand& u, double /*t*/) {
                 const auto shown = with.force_sensors(u), there = without.force_sensors(u);
                 EXPECT_NEAR(shown.torque_sensor_Nm, 1.2 * there.torque_sensor_Nm, 1e-9);
                 EXPECT_NEAR(shown.force_sensor_N, there.force_sensor_N, 1e-6);
                 EXPECT_NEAR(with.signals().position_m, without.signals().position_m, 1e-12);
               });
}

TEST(LearnedTables, AScaleShowsItsTableOverTheTravel) {
  double largest_m = 0.0;
  side_by_side({"learned_reading", {0.004}, {{0.0, 0.001, 0.002, 0.003}, {}, {}, {}, {}, {}, {0.0, 1e-5, 0.0, -1e-5}, {}}},
               [&](const FeedAxis& with, const FeedAxis& /*without*/, const AxisCommand& /*u*/, double /*t*/) {
                 const double x = with.signals().position_m, shown_m = with.signals().scale_position_m - x;
                 const double turned = std::abs(std::remainder(x - 0.001, 0.004));  // 0 at the crest, 0.002 in the valley
                 EXPECT_NEAR(shown_m, 1e-5 * (1.0 - turned / 0.001), 1e-9) << x;
                 largest_m = std::max(largest_m, std::abs(shown_m));
               });
  EXPECT_GT(largest_m, 9e-6);
}

TEST(LearnedTables, AForceSensorShowsItsTableOverTheVelocity) {
  side_by_side({"learned_reading", {0.0}, {{}, {-1.0, 1.0}, {}, {}, {}, {-50.0, 50.0}, {}, {}}},
               [](const FeedAxis& with, const FeedAxis& without, const AxisCommand& u, double /*t*/) {
                 const double more_N = with.force_sensors(u).force_sensor_N - without.force_sensors(u).force_sensor_N;
                 EXPECT_NEAR(more_N, 50.0 * with.signals().velocity_m_per_s, 1e-6);
               });
}

TEST(LearnedTables, ADriveDrawsItsTableOfTheClock) {
  side_by_side({"learned_reading", {1.0}, {{}, {}, {}, {0.0, 0.5}, {}, {}, {}, {0.0, 3.0}}},
               [](const FeedAxis& with, const FeedAxis& without, const AxisCommand& /*u*/, double t) {
                 EXPECT_NEAR(with.signals().power_W - without.signals().power_W,
                             3.0 * (1.0 - std::abs(std::remainder(t - 0.5, 1.0)) / 0.5), 1e-9)
                     << t;
               });
}

TEST(LearnedTables, ADriveMakesItsTableOfTheCommand) {
  side_by_side({"learned_command", {0.0}, {{-1.0, 1.0}, {-0.1, 0.1}}},
               [](const FeedAxis& with, const FeedAxis& /*without*/, const AxisCommand& u, double /*t*/) {
                 EXPECT_NEAR(with.signals().torque_Nm, 1.1 * u.torque_Nm, 1e-12);
               });
}

TEST(LearnedTables, AreRefusedWhereTheyAreNone) {
  const auto refused = [](EffectSetting table) { EXPECT_THROW(axis_with_table(std::move(table)), std::invalid_argument); };
  refused({"learned_reading", {0.0}, {{}, {}, {}, {}, {}, {1.0}, {}, {}}});               // no points
  refused({"learned_reading", {0.0}, {{0.0}, {0.0}, {}, {}, {}, {1.0}, {}, {}}});         // two kinds of points
  refused({"learned_reading", {0.0}, {{0.0}, {}, {}, {}, {}, {}, {}, {}}});               // no channel
  refused({"learned_reading", {0.0}, {{0.0}, {}, {}, {}, {1.0}, {1.0}, {}, {}}});         // two channels
  refused({"learned_reading", {0.0}, {{0.0, 1.0}, {}, {}, {}, {1.0}, {}, {}, {}}});       // a value short
  refused({"learned_reading", {0.0}, {{1.0, 0.0}, {}, {}, {}, {1.0, 1.0}, {}, {}, {}}});  // descending
  refused({"learned_reading", {1.0}, {{0.0, 1.0}, {}, {}, {}, {1.0, 1.0}, {}, {}, {}}});  // a period and its end
  refused({"learned_command", {0.0}, {{}, {}}});
  refused({"learned_command", {0.0}, {{0.0}, {1.0, 2.0}}});
}

}  // namespace
}  // namespace feedtwin::plant
