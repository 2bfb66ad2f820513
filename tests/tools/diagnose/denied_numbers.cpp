// Recalibrated numbers that runs which were not fitted deny.

#include "tools/diagnose/denied_numbers.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/named_effect.h"
#include "tools/diagnose/diagnosis_json.h"
#include "tools/diagnose/sentence.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Of a command and a sensor, this many times as far off as by the file's numbers, which leave ten times the noise.
Diagnosis recalibrated_to(double command_times, double sensor_times) {
  Diagnosis result;
  result.verdict = "recalibrate";
  result.recalibrated.push_back({"guide.mass_kg", 10.0, {11.0, 10.9, 11.1}});
  for (const auto& [channel, times] : {std::pair("torque_cmd_Nm", command_times), {"torque_sensor_Nm", sensor_times}})
    result.holdout[channel] = {.before = 0.1, .recalibrated = 0.1 * times, .after = 0.1 * times, .floor = 0.01};
  return result;
}

TEST(DeniedNumbers, WhereTheFilesLeaveUnseenRunsCloserOnTheWhole) {
  EXPECT_TRUE(numbers_are_denied(recalibrated_to(1.2, 1.0)));
  EXPECT_FALSE(numbers_are_denied(recalibrated_to(1.02, 1.0))) << "hardly";
  EXPECT_FALSE(numbers_are_denied(recalibrated_to(1.2, 0.5))) << "a sensor is much closer";
}

TEST(DeniedNumbers, NotBesideANameThatRestsOnAForceNorAPartThatRings) {
  Diagnosis result = recalibrated_to(1.2, 1.0);
  result.effects.push_back(tests::named("lead_error", "relative_error", 1e-5));
  EXPECT_TRUE(numbers_are_denied(result));
  result.effects.push_back(tests::named("cogging", "amplitude_Nm", 0.01));
  EXPECT_FALSE(numbers_are_denied(result));
  Diagnosis rings = recalibrated_to(1.2, 1.0);
  rings.unknown.emplace();
  EXPECT_TRUE(numbers_are_denied(rings));
  rings.unknown->mode.emplace();
  EXPECT_FALSE(numbers_are_denied(rings));
}

TEST(DeniedNumbers, BentByMoreThanChanceTheyStandForTheUnknown) {
  EXPECT_TRUE(numbers_stand_for_the_unknown(recalibrated_to(1.1, 2.5)));
  EXPECT_FALSE(numbers_stand_for_the_unknown(recalibrated_to(1.1, 1.9))) << "no channel is twice as far off";
  EXPECT_FALSE(numbers_stand_for_the_unknown(recalibrated_to(0.7, 2.5))) << "not on the whole";
  auto noisy = recalibrated_to(1.1, 2.5);
  noisy.holdout.at("torque_sensor_Nm").floor = 0.1;
  EXPECT_FALSE(numbers_stand_for_the_unknown(noisy));
  auto named = recalibrated_to(1.1, 2.5);
  named.effects.push_back(tests::named("lead_error", "relative_error", 1e-5));
  EXPECT_FALSE(numbers_stand_for_the_unknown(named));
}

TEST(DeniedNumbers, AreToldNoMoreAndTheFilesStandInTheirPlaceIfTheyAreCloser) {
  Diagnosis result = recalibrated_to(1.2, 1.2);
  result.motor_presliding_m = 1e-6;
  take_the_files_numbers(result, plant::source_axis());
  EXPECT_NEAR(result.numbers_denied_by_unseen, 1.2, 1e-9);
  EXPECT_EQ(result.verdict, "agrees");
  EXPECT_TRUE(result.recalibrated.empty());
  EXPECT_EQ(result.motor_presliding_m, 0.0);
  EXPECT_TRUE(still_denied(result)) << "figures as before";
  for (auto& [channel, error] : result.holdout) error.after = error.before;
  EXPECT_FALSE(still_denied(result));
  const auto text = summary_of(result);
  EXPECT_NE(text.find("1.20 times as far off as the file's own"), std::string::npos) << text;
  EXPECT_EQ(text.find("Model and recording agree"), std::string::npos) << text;
  EXPECT_NEAR(to_json(result, "axis.updated.toml")["numbers_denied_by_unseen"].get<double>(), 1.2, 1e-9);
}

TEST(DeniedNumbers, OnlyWhatIsNamedStandsBesideTheFiles) {
  const Candidate model{plant::source_axis(),
                        {{&hypothesis("lead_error"), {1e-5}}, {&hypothesis("presliding_memory"), {5.0, 1e-6}}}};
  const auto kept = only_told(model, {tests::named("lead_error", "relative_error", 1e-5)});
  ASSERT_EQ(kept.effects.size(), 1U);
  EXPECT_EQ(kept.effects.front().hypothesis->id, "lead_error");
}

// Runs to learn from by an axis whose oil was cold, and one to prove it on by one that had nearly the file's.
TEST(DeniedNumbers, AWholeDiagnosisKeepsTheFilesAndNoChannelIsWorseThanBefore) {
  const auto with_oil = [](double times) {
    auto axis = plant::source_axis();
    for (auto* number : {&axis.ball_screw.viscous_Ns_per_m, &axis.guide.viscous_Ns_per_m})
      number->pos *= times, number->neg *= times;
    return axis;
  };
  auto data = tests::short_case(with_oil(1.1), plant::source_axis());
  data.holdout = tests::short_case(with_oil(1.04), plant::source_axis()).holdout;
  const auto found = diagnose(data, [](std::string_view) {});
  EXPECT_EQ(found.verdict, "agrees");
  EXPECT_GT(found.numbers_denied_by_unseen, 1.1);
  EXPECT_EQ(found.updated.guide.viscous_Ns_per_m.pos, plant::source_axis().guide.viscous_Ns_per_m.pos);
  for (const auto& [channel, error] : found.holdout) EXPECT_EQ(error.after, error.before) << channel;
}

}  // namespace
}  // namespace feedtwin
