// Names that go about half of the closed loop's way are no bite of something else, whatever structure they leave.

#include "tools/diagnose/forward/most_of_the_way.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/tools/diagnose/cogged.h"
#include "tools/diagnose/verdict.h"

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

/// Runs with a damaged spot, of which as many newtons are told as an effect has; all else is right.
struct OnASpot {
  static constexpr double height_N = 60.0, centre_m = 0.0, half_width_m = 0.004;
  tools::Case data = made();
  InverseModel model{make_tracks(data.fit, data.axis), data.axis};
  Fitter fitter{model, data.axis};
  ForwardModel forward{data.fit, data};

  static plant::AxisParameters with_the_spot() {
    auto truth = plant::source_axis();
    truth.effects.push_back(
        tests::effect("local_friction", {{"height_N", height_N}, {"centre_m", centre_m}, {"half_width_m", half_width_m}}));
    return truth;
  }
  static tools::Case made() { return tests::short_case(with_the_spot(), plant::source_axis()); }
  /// By the inverse model alone, and by both engines.
  [[nodiscard]] std::pair<bool, bool> unknown_with(const std::vector<Active>& told) const {
    SearchResult found;
    found.recalibrated.model = {data.axis, {}};
    found.recalibrated.residual = model.residual(data.axis, {});
    for (const auto& effect : told) found.found.emplace_back().effect = effect;
    const Candidate named{data.axis, told};
    return {beyond_the_catalogue(fitter, found, named, tests::silent),
            is_unknown(forward, fitter, found, named, tests::silent)};
  }
};

TEST(IsUnknown, NotWhereTheClosedLoopGoesItsWayByTheNames) {
  const OnASpot made;
  const Active a_quarter{&hypothesis("local_friction"),
                         {0.25 * OnASpot::height_N, OnASpot::centre_m, OnASpot::half_width_m, 0.0}},
      another{&hypothesis("cable_spring"), {5.0, 0.0}};
  EXPECT_EQ(made.unknown_with({a_quarter}), std::pair(true, false));
  EXPECT_EQ(made.unknown_with({another}), std::pair(true, true));
  EXPECT_EQ(made.unknown_with({}), std::pair(true, true));
}

TEST(BesideTheNames, StaysWhatIsOfNoSizeToBeNamedOrRestsOnNoForce) {
  const OnASpot made;
  SearchResult found;
  found.recalibrated.model = {OnASpot::with_the_spot(), {}};
  found.whitening = made.fitter.colour_of(made.model.residual(made.data.axis, {}));
  const Active spot{&hypothesis("local_friction"), {OnASpot::height_N, OnASpot::centre_m, OnASpot::half_width_m, 0.0}},
      stiff_screw{&hypothesis("screw_compliance"), {1.0 / 3e8, 7.6}};
  ASSERT_FALSE(worth_naming(stiff_screw, made.data.axis));
  const auto beside = beside_the_names(made.fitter, found, {made.data.axis, {stiff_screw, spot}});
  ASSERT_EQ(beside.effects.size(), 1U);
  EXPECT_EQ(beside.effects.front().hypothesis, stiff_screw.hypothesis);
  EXPECT_GT(beside.axis.guide.coulomb_N.pos, made.data.axis.guide.coulomb_N.pos)
      << "refitted, so that it holds the spot's mean";
  const auto alone = beside_the_names(made.fitter, found, {made.data.axis, {spot}});
  EXPECT_TRUE(alone.effects.empty());
  EXPECT_EQ(alone.axis.effects.size(), 1U) << "the recalibrated numbers as they were found";
}

TEST(IsUnknown, NotWhereTheNumbersAloneBringTheClosedLoopToItsNoise) {
  const OnASpot made;
  SearchResult found;
  found.recalibrated.model = {OnASpot::with_the_spot(), {}};  // as if numbers did what the spot does
  found.recalibrated.residual = made.model.residual(made.data.axis, {});
  const Candidate nothing{made.data.axis, {}};
  ASSERT_TRUE(beyond_the_catalogue(made.fitter, found, nothing, tests::silent));
  EXPECT_FALSE(is_unknown(made.forward, made.fitter, found, nothing, tests::silent));
  found.recalibrated.model = nothing;
  EXPECT_TRUE(is_unknown(made.forward, made.fitter, found, nothing, tests::silent));
}

TEST(TimesNoise, IsOfTheWorstChannelButThePowerMeters) {
  const Nrmse floor{{"torque_cmd_Nm", 0.01}, {"force_sensor_N", 0.02}, {"power_W", 0.001}, {"scale_position_m", 0.0}};
  const Nrmse error{{"torque_cmd_Nm", 0.03}, {"force_sensor_N", 0.05}, {"power_W", 0.5}, {"scale_position_m", 0.1}};
  EXPECT_NEAR(times_noise(error, floor), 3.0, 1e-12);
}

}  // namespace
}  // namespace feedtwin
