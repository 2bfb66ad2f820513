// A torque that fails for moments is told from noise that comes in bursts.

#include "tools/diagnose/dropouts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/support/made_case.h"
#include "tools/diagnose/diagnosis_json.h"
#include "tools/diagnose/sentence.h"
#include "tools/diagnose/unknown.h"
#include "tools/diagnose/verdict.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// What is wrong with the command that a run has recorded, for some samples every now and then.
using Fault = std::function<double(double command_Nm)>;

/// Runs of the source's axis. The motion stays as it was made: what the controller would make of it does not matter here.
std::vector<tools::Recording> runs_with(const Fault& fault, unsigned seed = 1, std::size_t long_samples = 5) {
  std::mt19937 chance(seed);
  std::uniform_int_distribution<std::size_t> pause(250, 800);
  std::vector<tools::Recording> runs;
  for (const char* motion : {"triangle", "sine"}) {
    tests::MadeRun made{.motion = motion, .duration_s = 8.0, .sensors = false};
    made.settings.speed_m_per_s = 0.1, made.settings.amplitude_m = 0.03;
    auto run = tests::make_recording(plant::source_axis(), made);
    auto& command_Nm = run.channels.at(std::string(tools::channel::torque_cmd_Nm));
    for (std::size_t k = pause(chance); k + long_samples < command_Nm.size(); k += pause(chance))
      for (std::size_t i = k; i < k + long_samples; ++i) command_Nm[i] += fault(command_Nm[i]);
    runs.push_back(std::move(run));
  }
  return runs;
}

std::optional<Dropouts> found_in(const std::vector<tools::Recording>& runs) {
  const InverseModel model(make_tracks(runs, plant::source_axis()), plant::source_axis());
  return dropouts_of(model, {plant::source_axis(), {}});
}

TEST(Dropouts, AreToldWithTheShareThatFails) {
  for (const double share : {0.2, 0.6}) {
    // the axis moves by what is left: more had been commanded
    const auto found = found_in(runs_with([share](double torque_Nm) { return torque_Nm * share / (1.0 - share); }));
    ASSERT_TRUE(found.has_value()) << share;
    EXPECT_NEAR(found->share, share, 0.1 * share);
    EXPECT_GT(found->moments, 15U);
    EXPECT_LT(found->first_s, 1.0);
    EXPECT_GT(found->last_s, 6.0);
  }
}

TEST(Dropouts, BurstsThatDoNotGoByTheCommandAreNone) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 chance(seed);
    std::normal_distribution<double> burst_Nm(0.0, 0.1);
    EXPECT_FALSE(found_in(runs_with([&](double /*torque_Nm*/) { return burst_Nm(chance); }, seed)).has_value());
  }
}

TEST(Dropouts, NeitherAreMomentsAtWhichMoreActsThanWasAskedForNorNothingAtAll) {
  EXPECT_FALSE(found_in(runs_with([](double torque_Nm) { return -0.4 * torque_Nm; })).has_value());
  EXPECT_FALSE(found_in(runs_with([](double /*torque_Nm*/) { return 0.0; })).has_value());
}

// At a steady speed, here of a twelfth of a step a sample less than whole ones, all are as large, and so is what is
// commanded: 554 moments lacked 7 % of it.
TEST(Dropouts, NeitherAreTheStepsOfACoarseEncoder) {
  std::vector<tools::Recording> runs;
  for (const double speed_m_per_s : {0.05292, 0.05792}) {
    tests::MadeRun made{.motion = "triangle", .duration_s = 8.0, .sensors = false};
    made.settings.speed_m_per_s = speed_m_per_s, made.settings.amplitude_m = 0.03;
    runs.push_back(tests::make_recording(plant::source_axis(), made));
    constexpr double step_m = 1e-6;
    for (double& x : runs.back().channels.at(std::string(tools::channel::position_m))) x = step_m * std::round(x / step_m);
  }
  EXPECT_FALSE(found_in(runs).has_value());
}

TEST(Dropouts, WhatLastsAsADamagedSpotDoesIsNone) {
  EXPECT_FALSE(found_in(runs_with([](double torque_Nm) { return 0.5 * torque_Nm; }, 1, 40)).has_value());
}

TEST(Dropouts, AFewAreNotEnough) {
  auto runs = runs_with([](double torque_Nm) { return torque_Nm; });
  runs.resize(1);
  for (auto& [name, values] : runs.front().channels) values.resize(3000);
  EXPECT_FALSE(found_in(runs).has_value());
}

// At a steady speed it opposes every pass for as long and by as much.
TEST(Dropouts, ADamagedSpotLooksLikeThemUntilItIsNamed) {
  const std::vector<double> narrow{25.0, 0.004, 0.0005, 0.0};
  plant::AxisParameters truth = plant::source_axis();
  truth.effects.push_back(
      tests::effect("local_friction", {{"height_N", narrow[0]}, {"centre_m", narrow[1]}, {"half_width_m", narrow[2]}}));
  tests::MadeRun made{.motion = "triangle", .duration_s = 12.0, .sensors = false};
  made.settings.speed_m_per_s = 0.1, made.settings.amplitude_m = 0.03;
  const auto runs = std::vector{tests::make_recording(truth, made)};
  const InverseModel model(make_tracks(runs, plant::source_axis()), plant::source_axis());
  const Candidate nothing{plant::source_axis(), {}}, spot{plant::source_axis(), {{&hypothesis("local_friction"), narrow}}};
  EXPECT_TRUE(dropouts_of(model, nothing).has_value());
  EXPECT_TRUE(torque_fails_for_moments(model, nothing, nothing));
  EXPECT_FALSE(torque_fails_for_moments(model, nothing, spot));
}

TEST(Dropouts, AreBeyondTheCatalogueAndSaidWithWhatFails) {
  const auto runs = runs_with([](double torque_Nm) { return 0.5 * torque_Nm; });
  const InverseModel model(make_tracks(runs, plant::source_axis()), plant::source_axis());
  const Fitter fitter(model, plant::source_axis());
  const Candidate nothing{plant::source_axis(), {}};
  SearchResult found;
  found.recalibrated.residual = model.residual(nothing.axis, {});
  std::string said;
  EXPECT_TRUE(beyond_the_catalogue(fitter, found, nothing, [&said](std::string_view line) { said += line; }));
  EXPECT_NE(said.find("of the commanded torque fail"), std::string::npos) << said;
  Diagnosis told;
  told.verdict = "unknown";
  tell_what_no_table_holds(fitter, nothing, told.unknown.emplace());
  EXPECT_NE(summary_of(told).find("of the commanded torque"), std::string::npos) << summary_of(told);
  const auto json = to_json(told, "axis.updated.toml");
  EXPECT_EQ(json["unknown"]["axis"], "time");
  EXPECT_NEAR(json["unknown"]["dropouts"]["share_of_torque"].get<double>(), 1.0 / 3.0, 0.05);
}

}  // namespace
}  // namespace feedtwin
