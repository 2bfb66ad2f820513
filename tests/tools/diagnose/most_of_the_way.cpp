// Names that go about half of the closed loop's way are no bite of something else, whatever structure they leave.

#include "tools/diagnose/forward/most_of_the_way.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/tools/diagnose/cogged.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tests::Cogged;

TEST(MostOfTheWay, IsTheMeanOverTheChannelsThatAreOffBeyondNoise) {
  const Nrmse floor{{"torque_cmd_Nm", 0.01}, {"force_sensor_N", 0.02}, {"power_W", 0.03}};
  const Nrmse without{{"torque_cmd_Nm", 0.11}, {"force_sensor_N", 0.22}, {"power_W", 0.05}};
  const Nrmse with{{"torque_cmd_Nm", 0.06}, {"force_sensor_N", 0.02}, {"power_W", 0.5}};
  EXPECT_NEAR(share_of_the_way(without, with, floor), 0.75, 1e-12) << "power is off by less than twice its noise";
  EXPECT_EQ(share_of_the_way(floor, with, floor), 0.0) << "nothing is off";
  EXPECT_LT(share_of_the_way(with, without, floor), 0.0) << "worse with the names";
}

TEST(MostOfTheWay, ARightNameGoesItAndAWrongOneOrNoneDoesNot) {
  const Cogged made;
  const Candidate numbers{made.data.axis, {}};
  std::string said;
  const auto progress = [&said](std::string_view line) { said = line; };
  const auto goes = [&](const Candidate& named) {
    return names_go_most_of_the_way(made.forward, made.fitter, numbers, named, progress);
  };
  EXPECT_TRUE(goes({made.data.axis, {{&hypothesis("cogging"), {0.01, 0.0, 8.0}}}}));
  EXPECT_NE(said.find("% of the way"), std::string::npos);
  EXPECT_FALSE(goes({made.data.axis, {{&hypothesis("cable_spring"), {5.0, 0.0}}}}));
  said.clear();
  EXPECT_FALSE(goes(numbers));
  EXPECT_TRUE(said.empty()) << "nothing to ask about";
}

}  // namespace
}  // namespace feedtwin
