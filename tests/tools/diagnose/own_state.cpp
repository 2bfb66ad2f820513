// What each run begins with, and a ripple whose phase each run has of its own.

#include <gtest/gtest.h>

#include "plant/effects/registry.h"
#include "tests/support/made_case.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/own_phase.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

tools::Recording run_of(std::vector<plant::EffectSetting> effects, unsigned seed) {
  auto axis = plant::source_axis();
  axis.effects = std::move(effects);
  return tests::make_recording(axis, {.motion = "sine", .duration_s = 4.0, .scale_at_table = true, .seed = seed});
}

/// Runs that this effect acts in, each with its own numbers, and the noise's own colour.
struct Runs {
  InverseModel model;
  Fitter fitter{model, plant::source_axis()};
  Whitening whitening;

  explicit Runs(const std::vector<plant::EffectSetting>& effects)
      : model(make_tracks(runs(effects, true), plant::source_axis()), plant::source_axis()),
        whitening(colour(runs(effects, false))) {}

  [[nodiscard]] Candidate fitted(std::string_view id, std::vector<double> start) const {
    return fitter.fit({plant::source_axis(), {{&hypothesis(id), std::move(start)}}}, whitening, 15).model;
  }

 private:
  static std::vector<tools::Recording> runs(const std::vector<plant::EffectSetting>& effects, bool acts) {
    std::vector<tools::Recording> all;
    for (const auto& effect : effects) {
      const auto seed = static_cast<unsigned>(all.size()) + 1;
      all.push_back(acts ? run_of({effect}, seed) : run_of({}, seed));
    }
    return all;
  }
  static Whitening colour(const std::vector<tools::Recording>& plain) {
    const InverseModel without(make_tracks(plain, plant::source_axis()), plant::source_axis());
    return Whitening::estimate(without, without.residual(plant::source_axis(), {}));
  }
};

plant::EffectSetting drift(double initial_change) {
  return tests::effect("friction_drift",
                       {{"relative_change", -0.1}, {"time_constant_s", 3.0}, {"initial_change", initial_change}});
}

const std::vector<double> start_of_drift{0.0, 2.0, 0.0, 0.0, 0.0, 0.0};

double initial_change_of(const plant::AxisParameters& axis) {
  auto setting = axis.effects.front();
  return *plant::value_in(setting, *plant::find_effect(setting.id), "initial_change");
}

TEST(OwnState, WhatEachRunBeginsWithIsFittedAndSimulated) {
  const Runs runs({drift(0.0), drift(0.08), drift(-0.05)});
  const Candidate fitted = runs.fitted("friction_drift", start_of_drift);
  const auto& q = fitted.effects.front().q;
  EXPECT_NEAR(q[0], -0.1, 0.005);
  EXPECT_NEAR(q[1], 3.0, 0.3);
  EXPECT_NEAR(q[3], 0.08, 0.003);
  EXPECT_NEAR(q[4], -0.05, 0.003);
  EXPECT_TRUE(states_differ(fitted.effects.front()));
  const auto axes = extended(fitted);
  EXPECT_EQ(initial_change_of(axes.of(0)), 0.0);
  EXPECT_NEAR(initial_change_of(axes.of(1)), 0.08, 0.003);
  EXPECT_NEAR(initial_change_of(axes.common), 0.01, 0.002) << "the mean is handed on";
  const InverseModel unseen(make_tracks({run_of({drift(0.06)}, 9)}, plant::source_axis()), plant::source_axis());
  EXPECT_NEAR(for_unseen(unseen, runs.whitening, fitted).effects.front().q[2], 0.06, 0.005) << "taken from that run";
}

TEST(OwnState, WhereAllBeginAlikeAnUnseenRunDoesTooAndIsNotAsked) {
  const Runs runs({drift(0.0), drift(0.0), drift(0.0)});
  const Candidate fitted = runs.fitted("friction_drift", start_of_drift);
  EXPECT_FALSE(states_differ(fitted.effects.front()));
  const InverseModel unseen(make_tracks({run_of({drift(0.06)}, 9)}, plant::source_axis()), plant::source_axis());
  const auto told = for_unseen(unseen, runs.whitening, fitted).effects.front();
  for (std::size_t run = 0; run < line_runs; ++run) EXPECT_EQ(told.q[state_of_run(told.hypothesis->first_state, run)], 0.0);
}

TEST(OwnState, AStepBetweenSessionsIsClearHoweverFarASlowDriftWouldGoInTheEnd) {
  const auto slow = [](double last_state) {
    return Active{&hypothesis("friction_drift"), {1.7, 765.0, 0.0, 0.01, last_state, 0.0}};
  };
  EXPECT_TRUE(states_differ(slow(0.05)));
  EXPECT_FALSE(states_differ(slow(0.015)));
}

TEST(OwnState, AScrewAndItsWarmthBeginAsTheRunBeforeLeftThem) {
  struct Row {
    std::string_view id;
    std::vector<std::pair<std::string_view, double>> numbers;
    std::string_view state;
    double before;
    std::vector<double> start;
  };
  for (const auto& [id, numbers, state, before, start] :
       {Row{"thermal_friction",
            {{"viscous_reduction", 0.3}, {"energy_scale_J", 6.0}},
            "initial_reduction",
            0.12,
            {0.0, 5.0, 0.0, 0.0, 0.0, 0.0}},
        Row{"screw_growth",
            {{"relative_growth", 1e-4}, {"time_constant_s", 2.0}, {"fixed_end_m", -0.1}},
            "initial_growth",
            4e-5,
            {0.0, 2.5, -0.07, 0.0, 0.0, 0.0, 0.0}}}) {
    const auto& entry = *plant::find_effect(id);
    auto first = plant::preset_of(entry);
    for (const auto& [name, value] : numbers) *plant::value_in(first, entry, name) = value;
    auto later = first;
    *plant::value_in(later, entry, state) = before;
    const auto q = Runs({first, later}).fitted(id, start).effects.front().q;
    EXPECT_NEAR(q[0], numbers[0].second, 0.05 * numbers[0].second) << id;
    EXPECT_NEAR(q[hypothesis(id).first_state + 1], before, 0.05 * before) << id;
  }
}

TEST(RevRipple, HasAPhaseOfItsOwnInEachRun) {
  const auto ripple = [](double phase_rad) {
    return tests::effect("rev_ripple", {{"amplitude_N", 3.0}, {"cycles_per_rev", 2.63}, {"phase_rad", phase_rad}});
  };
  std::vector<double> start(2 * line_runs + 1, 0.0);
  start.back() = 2.625;
  const auto found = Runs({ripple(0.4), ripple(-1.9)}).fitted("rev_ripple", start).effects.front();
  EXPECT_NEAR(line_amplitude(found.q), 3.0, 0.1);
  EXPECT_NEAR(found.q.back(), 2.63, 0.003);
  EXPECT_NEAR(std::arg(found.hypothesis->line_of(found.q, 0)), 0.4, 0.06);
  EXPECT_NEAR(std::arg(found.hypothesis->line_of(found.q, 1)), -1.9, 0.06);
  EXPECT_FALSE(phases_agree(found));
}

}  // namespace
}  // namespace feedtwin
