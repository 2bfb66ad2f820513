// Laws of friction on a direct drive, whose file gives the guide nearly all friction: the inverse model says of an axis
// whose contacts and laws have changed places what it said before, and what is told of it is told of the guide.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "plant/effects/registry.h"
#include "tests/support/made_case.h"
#include "tools/diagnose/inverse_model.h"
#include "tools/diagnose/mended_case.h"
#include "tools/diagnose/reported.h"
#include "tools/diagnose/sentence.h"

namespace feedtwin::tools::diagnosis {
namespace {

plant::AxisParameters direct_drive() {
  auto axis = plant::source_axis();
  std::swap(axis.ball_screw, axis.guide);
  axis.axis.friction_laws_on_guide = 1.0;
  return axis;
}

/// Any sizes of a law that its bounds allow.
std::vector<double> any_of(const Hypothesis& law, std::mt19937_64& random) {
  std::vector<double> q;
  for (const auto& parameter : law.parameters)
    q.push_back(std::uniform_real_distribution<double>(std::clamp(parameter.lowest, -0.4, 0.4),
                                                       std::clamp(parameter.highest, 0.1, 3.0))(random));
  return q;
}

TEST(LawsOnGuide, SayInTheInverseModelWhatTheySaidOfTheScrew) {
  const auto screw = plant::source_axis(), guide = direct_drive();
  const auto runs = std::vector{tests::make_recording(screw, {.motion = "sine", .duration_s = 2.0, .sensors = false})};
  const InverseModel of_screw(make_tracks(runs, screw), screw), of_guide(make_tracks(runs, guide), guide);
  std::mt19937_64 random(3);  // NOLINT(bugprone-random-generator-seed): the same sizes every time
  int laws = 0;
  for (const auto& law : hypotheses()) {
    if (!plant::find_effect(law.id)->of_contact) continue;
    const std::vector<Active> effects{{&law, any_of(law, random)}};
    const Vector then = of_screw.residual(screw, effects), now = of_guide.residual(guide, effects);
    EXPECT_LT((then - now).norm(), 1e-9 * then.norm()) << law.id;
    EXPECT_GT((then - of_screw.residual(screw, {})).norm(), 1e-3 * then.norm()) << law.id << " does nothing here";
    ++laws;
  }
  EXPECT_EQ(laws, 7);
}

TEST(LawsOnGuide, AreWhereTheFileGivesNearlyAllFriction) {
  const auto taken = [](plant::AxisParameters axis) {
    Case given;
    given.axis = std::move(axis);
    given.fit = {tests::make_recording(given.axis, {.motion = "sine", .duration_s = 1.0, .sensors = false})};
    std::vector<SetupFault> faults;
    return mended(given, faults, [](std::string_view) {}).axis.laws_on_guide();
  };
  auto direct = direct_drive();
  direct.axis.friction_laws_on_guide = 0.0;
  EXPECT_TRUE(taken(direct));
  EXPECT_FALSE(taken(plant::source_axis()));
  auto shared = plant::source_axis();
  shared.guide.coulomb_N = shared.ball_screw.coulomb_N;
  EXPECT_FALSE(taken(shared)) << "a guide that drags as much as the screw";
  direct.effects = {tests::effect("friction_drift", {{"relative_change", 0.1}, {"time_constant_s", 2.0}})};
  EXPECT_FALSE(taken(direct)) << "the file's own law means the screw";
}

TEST(LawsOnGuide, AreToldOfTheGuide) {
  const Active drift{&hypothesis("friction_drift"), {0.1, 2.0, 0.0, 0.0, 0.0, 0.0}};
  EXPECT_EQ(component_of(drift, plant::source_axis()), "ball_screw");
  EXPECT_EQ(component_of(drift, direct_drive()), "guide");
  EXPECT_EQ(component_of({&hypothesis("cogging"), {0.01, 0.0, 8.0}}, direct_drive()), "motor");
  NamedEffect told;
  told.hypothesis = drift.hypothesis;
  told.component = "guide";
  EXPECT_NE(sentence_of(told).find("guide: the guide's friction drifts"), std::string::npos) << sentence_of(told);
  told.component = "ball_screw";
  EXPECT_NE(sentence_of(told).find("ball_screw: the screw's friction drifts"), std::string::npos) << sentence_of(told);
}

}  // namespace
}  // namespace feedtwin::tools::diagnosis
