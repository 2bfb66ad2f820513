// What the closed loop is asked about once more: what the inverse model would welcome, and what it can say little about.

#include "tools/diagnose/forward/questions.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Every hypothesis, welcome by so much.
Screen all_welcome(double gain) {
  Screen screen;
  for (const auto& one : hypotheses()) {
    screen.scores.emplace_back();
    screen.scores.back().hypothesis = &one;
    screen.scores.back().gain = gain;
  }
  return screen;
}

long times_asked(const std::vector<Question>& all, std::string_view id) {
  return std::ranges::count(all, &hypothesis(id), [](const Question& one) { return one.score.hypothesis; });
}

TEST(Questions, WhatTheNumbersTakeUpIsAskedFromEachOfItsStartsHoweverLittleTheInverseModelWelcomesIt) {
  const auto all = questions(all_welcome(0.0), {});
  EXPECT_EQ(times_asked(all, "torque_offset"), 1);
  EXPECT_EQ(times_asked(all, "torque_gain_error"), 1);
  EXPECT_EQ(times_asked(all, "sensor_gain"), 2) << "the torque sensor and the force sensor";
  for (const auto& one : all) EXPECT_FALSE(one.start.empty()) << one.score.hypothesis->id;
}

TEST(Questions, WhatTheInverseModelWelcomesComesFirstAndIsFew) {
  const auto all = questions(all_welcome(1000.0), {}), little = questions(all_welcome(10.0), {});
  EXPECT_EQ(std::ranges::count_if(all, [](const Question& one) { return one.start.empty(); }), 4);
  EXPECT_TRUE(all.front().start.empty());
  EXPECT_EQ(std::ranges::count_if(little, [](const Question& one) { return one.start.empty(); }), 0);
}

TEST(Questions, NothingIsAskedOfWhatIsInTheModelNorOfWhatOneBristleLeavesAtReversals) {
  Candidate model;
  model.effects.push_back({&hypothesis("torque_offset"), {0.01}});
  EXPECT_EQ(times_asked(questions(all_welcome(1000.0), model), "torque_offset"), 0);
  EXPECT_EQ(times_asked(questions(all_welcome(1000.0), {}), "presliding_memory"), 0);
}

}  // namespace
}  // namespace feedtwin
