// What a channel shows that the axis does not do, and what a force that the model lacks is not.

#include "tools/diagnose/reading_structure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/structure.h"
#include "tools/recording/power_meter.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
namespace channel = tools::channel;

std::vector<tools::Recording> runs(double speed_m_per_s, const plant::AxisParameters& truth = plant::source_axis()) {
  std::vector<tools::Recording> all;
  for (const char* motion : {"sine", "triangle", "s_curve"}) {
    tests::MadeRun made{.motion = motion,
                        .duration_s = 8.0,
                        .torque_noise_Nm = 5e-4,
                        .force_noise_N = 0.05,
                        .power_noise_W = 0.05,
                        .seed = static_cast<unsigned>(all.size() + 1)};
    made.settings.speed_m_per_s = speed_m_per_s, made.settings.amplitude_m = 0.02;
    all.push_back(tests::make_recording(truth, made));
  }
  return all;
}

using Change = std::function<void(tools::Recording&)>;

/// Runs that were changed so, by the true numbers.
struct Seen {
  InverseModel model;
  Candidate truth{plant::source_axis(), {}};
};
Seen metered(std::vector<tools::Recording> all) {
  for (auto& run : all) run.meter = tools::meter_habit(all, plant::source_axis());
  return {InverseModel(make_tracks(all, plant::source_axis()), plant::source_axis())};
}
Seen changed_by(const Change& change, double speed_m_per_s = 0.06) {
  auto changed = runs(speed_m_per_s);
  for (auto& run : changed) change(run);
  return metered(std::move(changed));
}
/// Of what the true numbers leave over of the force.
double settled_rms_N(const Seen& seen) {
  return RepeatableStructure(seen.model).remaining(seen.model.residual(seen.truth.axis, {})).remainder_N;
}

/// What stands out of them.
std::optional<ReadingStructure> told_of(const Change& change, double speed_m_per_s = 0.06) {
  const Seen seen = changed_by(change, speed_m_per_s);
  return what_stands_out(seen.model, seen.truth, [](std::string_view) {});
}

void change(tools::Recording& run, std::string_view name, const std::function<double(double, std::size_t)>& to) {
  auto values = std::vector<double>(run.at(name).begin(), run.at(name).end());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = to(values[k], k);
  run.channels[std::string(name)] = std::move(values);
}

TEST(ReadingStructure, NothingStandsOutOfAnAxisThatTheModelHolds) {
  const Seen seen = changed_by([](tools::Recording&) {});
  const auto all = structure_of_readings(seen.model, seen.truth);
  EXPECT_EQ(all.size(), 5U);  // both sensors, command, scale, power
  for (const auto& reading : all) {
    EXPECT_FALSE(reading.stands_out()) << reading.channel;
    EXPECT_LT(reading.share, 0.2) << reading.channel;
  }
}

TEST(ReadingStructure, AMetersFewReadingsAndACommandKeepTimeByChanceMoreThanASensor) {
  const auto stands_out = [](std::string_view channel, double share) {
    ReadingStructure reading;
    reading.channel = channel;
    reading.follows = Follows::time;
    reading.share = share;
    reading.remainder = 1.0;
    return reading.stands_out();
  };
  EXPECT_FALSE(stands_out(tools::channel::power_W, 0.13));
  EXPECT_TRUE(stands_out(tools::channel::power_W, 0.45));
  EXPECT_FALSE(stands_out(tools::channel::torque_cmd_Nm, 0.13)) << "what disturbs the axis slowly is in it";
  EXPECT_TRUE(stands_out(tools::channel::torque_cmd_Nm, 0.45));
  EXPECT_TRUE(stands_out(tools::channel::scale_position_m, 0.13));
}

// A fan on the drive's supply, half of every 1.57 s.
TEST(ReadingStructure, ALoadThatKeepsTimeIsInThePower) {
  const auto told = told_of([](tools::Recording& run) {
    change(run, channel::power_W, [&](double p, std::size_t k) {
      const double t = static_cast<double>(k - k % 100) * run.sample_s + 0.4;
      return p + (std::fmod(t, 1.57) < 0.78 ? 1.0 : 0.0);
    });
  });
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->channel, channel::power_W);
  EXPECT_EQ(told->follows, Follows::time);
  EXPECT_NEAR(told->every, 1.57, 0.03);
  EXPECT_GT(told->share, 0.6);
}

TEST(ReadingStructure, AMeterThatShowsMoreInEachRunKeepsNoTime) {
  double offset_W = -0.3;
  const auto told = told_of([&](tools::Recording& run) {
    change(run, channel::power_W, [&](double p, std::size_t) { return p + offset_W; });
    offset_W += 0.3;
  });
  EXPECT_FALSE(told.has_value()) << told->channel << " follows " << what_it_follows(*told);
}

// The coil of a holding brake: on while the axis moves, and 0.4 s more.
TEST(ReadingStructure, ACoilThatIsLetGoAtRestFollowsHowLongTheAxisHasStood) {
  constexpr double coil_W = 0.5, standstill_m_per_s = 2e-4;
  constexpr std::size_t late = 400, window = 100;
  std::vector<tools::Recording> all;
  for (const double speed_m_per_s : {0.03, 0.05, 0.07}) {
    tests::MadeRun made{.motion = "s_curve", .duration_s = 8.0, .power_noise_W = 0.05, .seed = 1};
    made.settings.speed_m_per_s = speed_m_per_s, made.settings.amplitude_m = 0.015, made.settings.dwell_s = 0.9;
    all.push_back(tests::make_recording(plant::source_axis(), made));
    const auto& x = all.back().at(channel::position_m);
    std::size_t stood = 0;
    std::vector<double> power_W(x.size());
    for (std::size_t k = 10; k < x.size(); ++k) {
      stood = std::abs(x[k] - x[k - 10]) < 10.0 * standstill_m_per_s * all.back().sample_s ? stood + 1 : 0;
      power_W[k] = stood < late ? coil_W : 0.0;
    }
    change(all.back(), channel::power_W, [&](double p, std::size_t k) {
      double mean = 0.0;  // over the meter's window
      const std::size_t from = k - k % window, to = std::min(from + window, power_W.size());
      for (std::size_t i = from; i < to; ++i) mean += power_W[i] / static_cast<double>(to - from);
      return p + mean;
    });
  }
  const Seen seen = metered(std::move(all));
  const auto told = what_stands_out(seen.model, seen.truth, [](std::string_view) {});
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->channel, channel::power_W);
  EXPECT_EQ(told->follows, Follows::rest);
  EXPECT_GT(told->share, 0.6);
}

TEST(ReadingStructure, ACoarseConverterStepsInWhatIsRead) {
  constexpr double step_Nm = 0.02;
  const auto told = told_of([](tools::Recording& run) {
    change(run, channel::torque_sensor_Nm, [](double y, std::size_t) { return step_Nm * std::round(y / step_Nm); });
  });
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->channel, channel::torque_sensor_Nm);
  EXPECT_EQ(told->follows, Follows::reading_by_step);
  EXPECT_NEAR(told->every, step_Nm, 0.02 * step_Nm);
}

TEST(ReadingStructure, WhatActsIsNotWhatWasCommandedStepByStep) {
  constexpr double step_Nm = 0.03, size_Nm = 0.004;
  constexpr double with_torques_of_all_sizes_m_per_s = 0.2;
  const auto told = told_of(
      [](tools::Recording& run) {
        change(run, channel::torque_cmd_Nm,
               [](double u, std::size_t) { return u + size_Nm * std::sin(2.0 * std::numbers::pi * u / step_Nm); });
      },
      with_torques_of_all_sizes_m_per_s);
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->channel, channel::torque_cmd_Nm);
  EXPECT_NEAR(told->every, step_Nm, 0.02 * step_Nm);
}

TEST(ReadingStructure, ASensorThatReadsACurveIsToldByBothEquations) {
  const auto told = told_of([](tools::Recording& run) {
    change(run, channel::force_sensor_N, [](double y, std::size_t) { return y + 2.0 * std::sin(y / 4.0); });
  });
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->channel, channel::force_sensor_N);
  EXPECT_GT(told->of_reading, 0.8);
}

// A piezo sensor: y' = x' - y / T.
TEST(ReadingStructure, AChargeThatLeaksIsToldByWhatWasReadBefore) {
  constexpr double time_constant_s = 0.8;
  const auto told = told_of([](tools::Recording& run) {
    double leaked_N = 0.0;
    change(run, channel::force_sensor_N, [&](double x, std::size_t) {
      leaked_N += (x - leaked_N) * run.sample_s / time_constant_s;
      return x - leaked_N;
    });
  });
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->channel, channel::force_sensor_N);
  EXPECT_EQ(told->follows, Follows::reading_before);
}

TEST(ReadingStructure, ASensorsColouredNoiseFollowsNothingThoughItFollowsItself) {
  constexpr double noise_N = 0.6, correlated_s = 0.05;
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const auto told = told_of([&](tools::Recording& run) {
    const double kept = std::exp(-run.sample_s / correlated_s);
    double n = 0.0;
    change(run, channel::force_sensor_N, [&](double x, std::size_t) {
      n = kept * n + std::sqrt(1.0 - kept * kept) * noise_N * normal(generator);
      return x + n;
    });
  });
  EXPECT_FALSE(told.has_value()) << told->channel << " follows " << what_it_follows(*told);
}

// More friction of the screw along the travel: command, torque sensor and power show it alike.
TEST(ReadingStructure, AForceThatTheModelLacksIsNoReading) {
  auto truth = plant::source_axis();
  plant::EffectSetting wave{"learned_residual", {}, {{}, {}, {}, {}, {}, {}, {}}};
  for (int i = -50; i <= 50; ++i) {
    const double at_m = 5e-4 * i;
    wave.lists[0].push_back(at_m);
    wave.lists[3].push_back(20.0 * std::sin(at_m / 0.004));
  }
  truth.effects.push_back(std::move(wave));
  const Seen seen = metered(runs(0.06, truth));
  EXPECT_GT(settled_rms_N(seen), 2.0) << "the force is there";
  const auto told = what_stands_out(seen.model, seen.truth, [](std::string_view) {});
  EXPECT_FALSE(told.has_value()) << told->channel;
}

/// How far off each channel of the last run is, with and without the table that is learned of the others.
struct RunInThePlant {
  std::optional<LearnedReading> table;
  Nrmse without, with;
};
RunInThePlant learned_of(std::vector<tools::Recording> all) {
  for (auto& run : all) run.meter = tools::meter_habit(all, plant::source_axis());
  tools::Case data;
  data.axis = plant::source_axis();
  data.holdout = {all.back()};
  all.pop_back();
  data.fit = all;
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const auto out = what_stands_out(model, {data.axis, {}}, [](std::string_view) {});
  if (!out || !out->table) return {};
  const ForwardModel held_out(data.holdout, data);
  auto axis = data.axis;
  extend(axis, *out->table);
  return {out->table, held_out.nrmse(data.axis), held_out.nrmse(axis)};
}

TEST(ReadingStructure, TheCurveThatASensorReadsRunsInThePlant) {
  auto all = runs(0.06);
  for (auto& run : all) change(run, channel::force_sensor_N, [](double y, std::size_t) { return y + std::sin(y); });
  const auto found = learned_of(std::move(all));
  ASSERT_TRUE(found.table.has_value());
  EXPECT_EQ(found.table->channel, channel::force_sensor_N);
  EXPECT_EQ(found.table->over, Follows::reading);
  EXPECT_LT(found.with.at("force_sensor_N"), 0.4 * found.without.at("force_sensor_N"));
  EXPECT_NEAR(found.with.at("torque_cmd_Nm"), found.without.at("torque_cmd_Nm"), 1e-9);
}

TEST(ReadingStructure, WhatADriveMakesOfItsCommandsRunsInThePlant) {
  auto truth = plant::source_axis();
  plant::EffectSetting steps{"learned_command", {0.03}, {{}, {}}};
  for (int i = 0; i < 16; ++i) {
    steps.lists[0].push_back(0.03 * i / 16);
    steps.lists[1].push_back(0.004 * std::sin(2.0 * std::numbers::pi * i / 16));
  }
  truth.effects.push_back(steps);
  const auto found = learned_of(runs(0.2, truth));
  ASSERT_TRUE(found.table.has_value());
  EXPECT_EQ(found.table->channel, channel::torque_cmd_Nm);
  EXPECT_NEAR(found.table->period, 0.03, 6e-4);
  EXPECT_LT(found.with.at("torque_cmd_Nm"), 0.7 * found.without.at("torque_cmd_Nm"));
}

// A fan is on when it is: what it did in one run says nothing of another.
TEST(ReadingStructure, AClockThatEachRunMeetsAtAnotherTimeIsNoTable) {
  auto all = runs(0.06);
  double ahead_s = 0.0;
  for (auto& run : all) {
    ahead_s += 0.61;
    change(run, channel::power_W, [&](double p, std::size_t k) {
      const double t = static_cast<double>(k - k % 100) * run.sample_s + ahead_s;
      return p + (std::fmod(t, 1.57) < 0.78 ? 1.0 : 0.0);
    });
  }
  EXPECT_FALSE(learned_of(std::move(all)).table.has_value());
}

}  // namespace
}  // namespace feedtwin
