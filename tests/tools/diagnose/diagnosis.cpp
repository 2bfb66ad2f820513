// Small cases made by the plant itself: what is missing from the nominal model is named, what is not missing never.

#include "tools/diagnose/diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "plant/effects/registry.h"
#include "plant/feed_axis.h"
#include "tests/support/made_case.h"
#include "tools/config/axis_file.h"
#include "tools/diagnose/diagnosis_json.h"
#include "tools/recording/power_meter.h"

namespace feedtwin {
namespace {

using tools::diagnosis::Diagnosis;

plant::AxisParameters off_by_some_percent() {
  auto nominal = plant::source_axis();
  nominal.motor.inertia_kgm2 *= 1.05;
  nominal.ball_screw.coulomb_N.pos *= 0.94;
  nominal.ball_screw.viscous_Ns_per_m.neg *= 1.07;
  nominal.motor.coulomb_N.neg *= 0.95;
  return nominal;
}

Diagnosis diagnosed(const plant::AxisParameters& truth) {
  return tools::diagnosis::diagnose(tests::short_case(truth, off_by_some_percent()), [](std::string_view) {});
}

std::string ids_of(const Diagnosis& found) {
  std::string ids;
  for (const auto& effect : found.effects) ids += std::string(effect.hypothesis->id) + " ";
  return ids;
}

double value_of(const Diagnosis& found, std::string_view parameter) {
  for (const auto& [name, estimate] : found.effects.at(0).parameters)
    if (name == parameter) return estimate.value;
  return std::nan("");
}

TEST(Diagnosis, WrongNumbersAreRecalibratedAndNothingIsNamed) {
  const auto found = diagnosed(plant::source_axis());
  EXPECT_EQ(found.verdict, "recalibrate");
  EXPECT_EQ(ids_of(found), "");
  const auto& torque = found.holdout.at("torque_cmd_Nm");
  EXPECT_LT(torque.recalibrated, 0.5 * torque.before);
}

TEST(Diagnosis, TheUpdatedAxisHasTheMeterAsItReads) {
  auto truth = plant::source_axis();
  truth.power_meter_window_s = 0.2, truth.power_meter_readings = 2.0;
  auto data = tests::short_case(truth, off_by_some_percent());
  for (auto* runs : {&data.fit, &data.holdout})
    for (auto& run : *runs) run = tests::make_recording(truth, {.duration_s = 4.0});
  const auto habit = tools::meter_habit(data.fit, data.axis);
  for (auto* runs : {&data.fit, &data.holdout})
    for (auto& run : *runs) run.meter = habit;
  const auto found = tools::diagnosis::diagnose(data, [](std::string_view) {});
  ASSERT_EQ(found.setup.size(), 1U);
  EXPECT_EQ(found.setup[0].id, "power_meter_window");
  EXPECT_NEAR(found.updated.power_meter_window_s, 0.2, 1e-9);
  EXPECT_EQ(found.updated.power_meter_readings, 2.0);
}

// A force sensor whose amplifier bends: the axis is as the model has it.
TEST(Diagnosis, WhatASensorShowsAndTheAxisDoesNotDoIsUnknownAndTheUpdatedAxisShowsIt) {
  tools::Case data;
  data.axis = off_by_some_percent();
  for (const char* motion : {"sine", "s_curve", "triangle"}) {
    tests::MadeRun made{
        .motion = motion, .duration_s = 6.0, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05, .power_noise_W = 0.05};
    made.settings.speed_m_per_s = 0.06, made.settings.amplitude_m = 0.02;
    auto run = tests::make_recording(plant::source_axis(), made);
    for (double& force_N : run.channels.at("force_sensor_N")) force_N += std::sin(force_N);
    (data.fit.size() < 2 ? data.fit : data.holdout).push_back(std::move(run));
  }
  const auto found = tools::diagnosis::diagnose(data, [](std::string_view) {});
  EXPECT_EQ(ids_of(found), "");
  EXPECT_EQ(found.verdict, "unknown");
  ASSERT_TRUE(found.unknown_reading.has_value());
  EXPECT_EQ(found.unknown_reading->channel, "force_sensor_N");
  EXPECT_TRUE(found.unknown_reading->in_plant);
  EXPECT_TRUE(std::ranges::any_of(found.updated.effects, [](const auto& e) { return e.id == "learned_reading"; }));
  const auto& force = found.holdout.at("force_sensor_N");
  EXPECT_LT(force.after, 0.7 * force.recalibrated);
  const auto unknown = tools::diagnosis::to_json(found, "").at("unknown");
  EXPECT_EQ(unknown.at("channel"), "force_sensor_N");
  EXPECT_TRUE(unknown.at("in_updated_axis"));
}

TEST(Diagnosis, CoggingIsNamedAloneWithItsSizeAndTheUpdatedAxisHoldsIt) {
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("cogging", {{"amplitude_Nm", 0.01}, {"cycles_per_rev", 8.0}, {"phase_rad", 0.7}}));
  const auto found = diagnosed(truth);
  EXPECT_EQ(found.verdict, "named");
  ASSERT_EQ(ids_of(found), "cogging ");
  EXPECT_NEAR(value_of(found, "amplitude_Nm"), 0.01, 3e-4);
  EXPECT_EQ(value_of(found, "cycles_per_rev"), 8.0);
  EXPECT_NEAR(value_of(found, "phase_rad"), 0.7, 0.05);
  const auto& torque = found.holdout.at("torque_cmd_Nm");
  EXPECT_LT(torque.after, 0.2 * torque.recalibrated) << "on a run that the fit never saw";

  tests::ScratchFolder folder("diagnosis_axis");
  tools::write_axis_file(folder / "axis.toml", found.updated);
  const auto back = tools::read_axis_file(folder / "axis.toml");
  ASSERT_EQ(back.effects.size(), 1U);
  EXPECT_EQ(back.effects[0].id, "cogging");
  plant::FeedAxis axis(back);
  for (int tick = 0; tick < 100; ++tick) axis.step({.torque_Nm = 0.2}, 1e-3);
  EXPECT_TRUE(std::isfinite(axis.signals().position_m));
}

TEST(Diagnosis, TheSameRecordingGivesTheSameAnswer) {
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("current_loop_lag", {{"time_constant_s", 2e-3}}));
  const auto first = diagnosed(truth), second = diagnosed(truth);
  EXPECT_EQ(tools::diagnosis::to_json(first, "a").dump(), tools::diagnosis::to_json(second, "a").dump());
  EXPECT_NE(ids_of(first).find("current_loop_lag"), std::string::npos) << ids_of(first);
}

TEST(Diagnosis, EveryHypothesisIsAnEffectOfThePlantWithTheSameParameterNames) {
  for (const auto& hypothesis : tools::diagnosis::hypotheses()) {
    const auto* entry = plant::find_effect(hypothesis.id);
    ASSERT_NE(entry, nullptr) << hypothesis.id;
    const std::vector<double> q(hypothesis.parameters.size(), 0.5);
    for (const auto& [name, value] : hypothesis.named(q, plant::source_axis())) {
      auto made = plant::preset_of(*entry);
      EXPECT_NE(plant::value_in(made, *entry, name), nullptr) << hypothesis.id << "." << name;
      EXPECT_TRUE(std::isfinite(value)) << hypothesis.id << "." << name;
    }
  }
}

// A law reads its numbers by their places: what begins a search or a polish has to have them all.
TEST(Diagnosis, EveryStartOfAHypothesisHoldsAllItsParameters) {
  for (const auto& hypothesis : tools::diagnosis::hypotheses()) {
    const auto shaping = std::ranges::count_if(hypothesis.parameters,
                                               [](const auto& p) { return p.kind != tools::diagnosis::Kind::amplitude; });
    for (const auto& shape : hypothesis.shapes) EXPECT_EQ(shape.size(), static_cast<std::size_t>(shaping)) << hypothesis.id;
    for (const auto* starts : {&hypothesis.starts, &hypothesis.closed_loop_starts})
      for (const auto& start : *starts) EXPECT_EQ(start.size(), hypothesis.parameters.size()) << hypothesis.id;
  }
}

TEST(DiagnosisJson, HoldsEveryFieldThatScriptsRelyOn) {
  Diagnosis found;
  found.verdict = "agrees";
  const auto json = tools::diagnosis::to_json(found, "axis.updated.toml");
  for (const char* key :
       {"verdict", "effects", "alternatives", "recalibrated", "holdout", "energy", "next_experiment", "updated_axis"})
    EXPECT_TRUE(json.contains(key)) << key;
}

}  // namespace
}  // namespace feedtwin
