// A force that is on or off is told from noise, from friction, and from what switches too seldom to be sure of.

#include "tools/diagnose/switching.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
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

/// What acts against the table, sample by sample, beside what the model knows.
using Force = std::function<double(double at_s, double velocity_m_per_s)>;

/// Runs of the source's axis. The motion stays as it was made: what the controller would make of it does not matter here.
std::vector<tools::Recording> opposed_by(const Force& force_N) {
  const auto axis = plant::source_axis();
  const double Nm_per_N = axis.axis.lead_m / (2.0 * std::numbers::pi);
  std::vector<tools::Recording> runs;
  for (const char* motion : {"triangle", "sine"}) {
    tests::MadeRun made{.motion = motion, .duration_s = 8.0, .sensors = false};
    made.settings.speed_m_per_s = 0.05, made.settings.amplitude_m = 0.03;
    auto run = tests::make_recording(axis, made);
    auto& command_Nm = run.channels.at(std::string(tools::channel::torque_cmd_Nm));
    const auto position_m = run.at(tools::channel::position_m);
    for (std::size_t k = 1; k < command_Nm.size(); ++k)
      command_Nm[k] += Nm_per_N * force_N(static_cast<double>(k) * run.sample_s, position_m[k] - position_m[k - 1]);
    runs.push_back(std::move(run));
  }
  return runs;
}

/// On and off after times of their own.
Force now_and_then(double size_N, double mean_s, unsigned seed = 3) {
  return [=, chance = std::mt19937(seed), on = false, until_s = 0.0](double at_s, double /*velocity*/) mutable {
    if (at_s < until_s - 2.0 * mean_s) until_s = 0.0;  // another run
    if (at_s >= until_s) on = !on, until_s = at_s + mean_s * std::uniform_real_distribution(0.5, 1.5)(chance);
    return on ? size_N : 0.0;
  };
}

std::optional<Switching> found_in(const std::vector<tools::Recording>& runs) {
  const InverseModel model(make_tracks(runs, plant::source_axis()), plant::source_axis());
  return switching_of(model, {plant::source_axis(), {}});
}

TEST(Switching, IsToldWithTheForceBetweenItsTwoValues) {
  for (const double size_N : {4.0, -15.0}) {
    const auto found = found_in(opposed_by(now_and_then(size_N, 0.5)));
    ASSERT_TRUE(found.has_value()) << size_N;
    EXPECT_NEAR(found->force_N, std::abs(size_N), 0.05 * std::abs(size_N));
    EXPECT_GT(found->share, 0.9);
    EXPECT_GT(found->switches, 15U);
    EXPECT_FALSE(found->opposes);
  }
}

TEST(Switching, AgainstTheMotionIsToldToo) {
  auto chips_N = now_and_then(8.0, 0.5);
  const auto found =
      found_in(opposed_by([&](double at_s, double velocity) { return std::copysign(chips_N(at_s, velocity), velocity); }));
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->opposes);
  EXPECT_NEAR(found->force_N, 8.0, 0.5);
}

TEST(Switching, NoiseIsNoneHoweverSlowItWavers) {
  for (const double correlated_s : {0.01, 0.3, 1.0}) {
    std::mt19937 chance(5);
    std::normal_distribution<double> normal;
    double now_N = 0.0;
    const double kept = std::exp(-1e-3 / correlated_s);
    const auto runs = opposed_by([&](double /*at_s*/, double /*velocity*/) {
      return now_N = kept * now_N + 8.0 * std::sqrt(1.0 - kept * kept) * normal(chance);
    });
    EXPECT_FALSE(found_in(runs).has_value()) << correlated_s;
  }
}

TEST(Switching, AWaveIsNone) {
  EXPECT_FALSE(found_in(opposed_by([](double at_s, double /*velocity*/) {
                 return 8.0 * std::sin(2.0 * std::numbers::pi * 1.3 * at_s);
               })).has_value());
}

TEST(Switching, WhatTurnsWithTheMotionIsFriction) {
  const auto runs = opposed_by([](double /*at_s*/, double velocity) { return velocity > 0.0 ? 8.0 : 0.0; });
  EXPECT_FALSE(found_in(runs).has_value());
}

TEST(Switching, OnceOrTwiceIsNotEnough) {
  EXPECT_FALSE(found_in(opposed_by(now_and_then(8.0, 3.0))).has_value());
}

TEST(Switching, IsBeyondTheCatalogueAndSaid) {
  const auto nominal = plant::source_axis();
  const InverseModel model(make_tracks(opposed_by(now_and_then(15.0, 0.5)), nominal), nominal);
  const Fitter fitter(model, nominal);
  const Candidate nothing{nominal, {}};
  EXPECT_TRUE(force_switches(model, nothing, nothing));
  SearchResult found;
  found.recalibrated.residual = model.residual(nominal, {});
  std::string lines;
  EXPECT_TRUE(beyond_the_catalogue(fitter, found, nothing, [&lines](std::string_view line) { lines += line; }));
  EXPECT_NE(lines.find("is on or off"), std::string::npos) << lines;
  Diagnosis told;
  told.verdict = "unknown";
  tell_what_no_table_holds(fitter, nothing, told.unknown.emplace());
  EXPECT_NE(summary_of(told).find("is on or off"), std::string::npos) << summary_of(told);
  const auto json = to_json(told, "axis.updated.toml");
  EXPECT_EQ(json["unknown"]["axis"], "time");
  EXPECT_NEAR(json["unknown"]["switching"]["force_N"].get<double>(), 15.0, 1.5);
}

}  // namespace
}  // namespace feedtwin
