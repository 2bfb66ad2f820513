// What a name that went has hidden.

#include "tools/diagnose/forward/hidden.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tools/diagnose/screen.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Runs with cogging and a cable's spring, of which the fit has the cogging alone; a torque offset stood for the spring.
class HiddenSpring : public testing::Test {
 protected:
  HiddenSpring() : runs_(data_.fit, data_.axis), forward_(data_.fit, data_) {
    for (const auto& score : screen(runs_.fitter, runs_.fit, runs_.whitening).scores)
      if (score.hypothesis == &hypothesis("cogging")) cogging_ = {score.hypothesis, score.q};
    fit_ = runs_.fitter.fit_with_colour({data_.axis, {cogging_}}, runs_.whitening, 2, 6);
    before_ = fit_.model.effects;
    before_.push_back({&hypothesis("torque_offset"), {0.001}});
    found_.recalibrated = runs_.fit;
    found_.whitening = runs_.whitening;
    found_.found = {known(cogging_)};
    found_.found.front().error_ratio = 7.0;
  }

  static tools::Case made() {
    auto truth = plant::source_axis();
    truth.effects.push_back(tests::effect("cogging", {{"amplitude_Nm", 0.01}, {"cycles_per_rev", 8.0}}));
    truth.effects.push_back(tests::effect("cable_spring", {{"stiffness_N_per_m", 600.0}, {"neutral_m", 0.0}}));
    return tests::short_case(truth, plant::source_axis());
  }

  static Found known(const Active& effect) {
    Found one;
    one.effect = effect;
    return one;
  }
  bool named(std::string_view id) { return has(fit_.model, hypothesis(id)) && found_.of(&hypothesis(id)) != nullptr; }
  bool name_them(const std::vector<Active>& before) {
    return name_what_they_hid(before, forward_, runs_.fitter, found_, fit_,
                              [this](std::string_view line) { said_.emplace_back(line); });
  }

  tools::Case data_ = made();
  tests::FittedRuns runs_;
  ForwardModel forward_;
  Active cogging_;
  Fit fit_;
  SearchResult found_;
  std::vector<Active> before_;
  std::vector<std::string> said_;
};

TEST_F(HiddenSpring, IsNamedWhenWhatStoodForItGoesAndWhatIsKnownOfTheOthersStays) {
  ASSERT_EQ(cogging_.hypothesis, &hypothesis("cogging"));
  EXPECT_TRUE(name_them(before_));
  EXPECT_TRUE(named("cable_spring"));
  ASSERT_TRUE(named("cogging"));
  EXPECT_FALSE(has(fit_.model, hypothesis("torque_offset")));
  EXPECT_GT(found_.of(&hypothesis("cable_spring"))->error_ratio, 1.0);  // the closed loop was asked too
  const auto spring = std::ranges::find(fit_.model.effects, &hypothesis("cable_spring"), &Active::hypothesis);
  EXPECT_NEAR(spring->q.front(), 600.0, 30.0);
}

TEST_F(HiddenSpring, NothingIsAskedWhereNoNameWent) {
  EXPECT_FALSE(name_them(fit_.model.effects));
  EXPECT_TRUE(said_.empty());
}

TEST_F(HiddenSpring, WhereNoNameComesAllStaysAsItWas) {
  const Active spring{&hypothesis("cable_spring"), {600.0, 0.0}};
  fit_ = runs_.fitter.fit_with_colour({data_.axis, {cogging_, spring}}, found_.whitening, 2, 6);
  found_.found.push_back(known(spring));
  const double cost = fit_.cost, left_over = found_.whitening.residual_rms(0);
  EXPECT_FALSE(name_them(before_));
  EXPECT_FALSE(said_.empty());
  EXPECT_EQ(fit_.cost, cost);
  EXPECT_EQ(found_.whitening.residual_rms(0), left_over);
  EXPECT_EQ(found_.found.size(), 2U);
}

TEST_F(HiddenSpring, WhatTheClosedLoopAloneAskedForStays) {
  const Active drag{&hypothesis("quadratic_drag"), {1.0}};
  fit_ = runs_.fitter.fit_with_colour({data_.axis, {cogging_, drag}}, found_.whitening, 2, 6);
  for (const bool by_closed_loop : {false, true}) {
    SearchResult found = found_;
    found.found.push_back(known(drag));
    found.found.back().by_closed_loop = by_closed_loop;
    const auto more = search_on(runs_.fitter, Bar{}, found, fit_, {&hypothesis("torque_offset")}, [](std::string_view) {});
    ASSERT_TRUE(more);
    EXPECT_EQ(has(more->final.model, hypothesis("quadratic_drag")), by_closed_loop);
    EXPECT_TRUE(has(more->final.model, hypothesis("cable_spring")));
  }
}

TEST_F(HiddenSpring, WhatWentIsNotAskedForAgain) {
  before_.push_back({&hypothesis("cable_spring"), {600.0, 0.0}});
  name_them(before_);
  EXPECT_FALSE(said_.empty());
  EXPECT_FALSE(has(fit_.model, hypothesis("cable_spring")));
  EXPECT_TRUE(named("cogging"));
}

TEST_F(HiddenSpring, SearchedOnKeepsWhatWasKnownOfAName) {
  const auto more = search_on(runs_.fitter, Bar{}, found_, fit_, {&hypothesis("torque_offset")}, [](std::string_view) {});
  ASSERT_TRUE(more);
  auto result = *more;
  ASSERT_NE(result.of(&hypothesis("cogging")), nullptr);
  EXPECT_DOUBLE_EQ(result.of(&hypothesis("cogging"))->error_ratio, 7.0);
  EXPECT_GT(result.of(&hypothesis("cogging"))->gain, 0.0);  // as it is now
  ASSERT_NE(result.of(&hypothesis("cable_spring")), nullptr);
  EXPECT_DOUBLE_EQ(result.of(&hypothesis("cable_spring"))->error_ratio, 1.0);
}

}  // namespace
}  // namespace feedtwin
