// Which hypothesis comes into the model first.

#include "tools/diagnose/preferred.h"

#include <gtest/gtest.h>

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

Tried tried(std::string_view id, std::vector<double> q, double value) {
  Tried one;
  one.fit.model.effects = {{&hypothesis(id), std::move(q)}};
  one.value = value;
  return one;
}

/// A sensor late by half a sample is how it is read; by two it is a finding.
Tried late_sensor(double late_s, double value) {
  return tried("channel_skew", {late_s, 0.0}, value);
}

std::string_view first_of(const std::vector<Tried>& all) {
  return preferred(all).fit.model.effects.back().hypothesis->id;
}

TEST(Preferred, ANuisanceWaitsForAFindingThatExplainsNearlyAsMuch) {
  EXPECT_EQ(first_of({late_sensor(9e-4, 100.0), tried("input_delay", {2e-3}, 80.0)}), "input_delay");
}

TEST(Preferred, AFindingThatExplainsClearlyLessDoesNotComeBeforeIt) {
  EXPECT_EQ(first_of({late_sensor(9e-4, 100.0), tried("input_delay", {2e-3}, 60.0)}), "channel_skew");
}

TEST(Preferred, ANuisanceWaitsForNothingThatItIsNotMistakenFor) {
  EXPECT_EQ(first_of({late_sensor(9e-4, 100.0), tried("cogging", {0.01, 0.0, 8.0}, 80.0)}), "channel_skew");
}

TEST(Preferred, OfFindingsTheOneThatExplainsMost) {
  EXPECT_EQ(first_of({tried("input_delay", {2e-3}, 80.0), late_sensor(3e-3, 100.0)}), "channel_skew");
}

TEST(ClearlyBetter, WhatHoldsTheNamedOneMustExplainAShareMore) {
  const Hypothesis &growth = hypothesis("screw_growth"), &lead = hypothesis("lead_error");
  EXPECT_DOUBLE_EQ(clearly_better(growth, lead, 6251.0), 0.03 * 6251.0) << "by 92 it took the place of a true wrong lead";
  EXPECT_DOUBLE_EQ(clearly_better(growth, lead, 100.0), 10.0);
  EXPECT_DOUBLE_EQ(clearly_better(lead, growth, 6251.0), 10.0);
  EXPECT_DOUBLE_EQ(clearly_better(hypothesis("cogging"), lead, 6251.0), 10.0);
}

}  // namespace
}  // namespace feedtwin
