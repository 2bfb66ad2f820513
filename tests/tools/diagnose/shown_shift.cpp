// What a sensor's answer to the command's jumps says of when it is read, without a model.

#include "tools/diagnose/shown_shift.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/confirm.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double one_ms_s = 1e-3;

/// A run whose force sensor answers each jump of the command by these shares, 0, 1, 2... samples later.
Track answering(const std::vector<double>& shares, double noise_N, unsigned seed) {
  constexpr Index size = 4000;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Track run;
  run.size = size;
  run.held_N = run.centred_m_per_s = run.motor_direction = run.force_sensor_N = Vector::Zero(size);
  for (Index n = 1; n < size; ++n) {
    run.held_N[n] = 0.97 * run.held_N[n - 1] + normal(random);
    run.centred_m_per_s[n] = run.centred_m_per_s[n - 1] + 1e-3 * run.held_N[n - 1] * one_ms_s * 100.0;
    run.motor_direction[n] = std::tanh(run.centred_m_per_s[n] / 1e-3);
    run.force_sensor_N[n] = 3.0 * run.motor_direction[n] + noise_N * normal(random);
    for (Index later = 0; later < static_cast<Index>(shares.size()) && later <= n; ++later)
      run.force_sensor_N[n] += 0.4 * shares[static_cast<std::size_t>(later)] * run.held_N[n - later];
  }
  return run;
}

ShownShift shown_by(const std::vector<double>& shares, double noise_N = 0.1) {
  return shown_shift({answering(shares, noise_N, 3), answering(shares, noise_N, 4)}, &Track::force_sensor_N);
}

TEST(ShownShift, IsHowManySamplesLaterAJumpIsShown) {
  const auto shown = shown_by({0.0, 0.0, 0.0, 0.4, 0.6});
  EXPECT_NEAR(shown.samples, 3.6, 0.05);
  EXPECT_GT(shown.share, 0.95);
  EXPECT_TRUE(surely_shifted(shown));
  EXPECT_FALSE(shown_a_sample_later(shown));
}

TEST(ShownShift, OneSampleIsHowASensorIsRead) {
  const auto shown = shown_by({0.0, 1.0});
  EXPECT_TRUE(shown_a_sample_later(shown));
  EXPECT_FALSE(surely_shifted(shown));
  for (const auto& at_once : {shown_by({1.0}), shown_by({0.6, 0.4})}) {
    EXPECT_FALSE(shown_a_sample_later(at_once)) << at_once.samples;
    EXPECT_FALSE(surely_shifted(at_once));
  }
}

// As late in the mean as the first two of these cases: what swings answers again and again.
TEST(ShownShift, WhatIsSpreadOverManySamplesIsNone) {
  EXPECT_FALSE(surely_shifted(shown_by({0.0, 0.0, 0.1, 0.3, 0.4, -0.1, -0.1, 0.3, 0.2, -0.1, -0.1, 0.2})));
  EXPECT_FALSE(shown_a_sample_later(shown_by({0.1, 0.6, 0.3, -0.3, 0.2, 0.3, -0.3})));
}

TEST(ShownShift, NoiseThatHidesTheAnswerLeavesItOpen) {
  for (double noise_N : {10.0, 30.0}) EXPECT_FALSE(surely_shifted(shown_by({0.0, 0.0, 0.0, 0.4, 0.6}, noise_N))) << noise_N;
}

TEST(ShownShift, WithoutAReadingNothingIsShown) {
  EXPECT_EQ(shown_shift({answering({1.0}, 0.1, 3)}, &Track::torque_sensor_N).share, 0.0);
  EXPECT_EQ(shown_shift({}, &Track::force_sensor_N).share, 0.0);
}

TEST(ShownShift, IsAskedOfTheSensorThatIsTheLaterOne) {
  const auto& skew = hypothesis("channel_skew");
  const std::vector runs{answering({0.0, 0.0, 0.0, 0.4, 0.6}, 0.1, 3)};
  ASSERT_NE(skew.shown, nullptr);
  EXPECT_TRUE(skew.shown(runs, std::array{0.0, 2.6e-3}));
  EXPECT_FALSE(skew.shown(runs, std::array{2.6e-3, 0.0}));
}

// Under its noise a sensor that is 3 ms late is not twice as far off without the name. That it is late is plain.
TEST(Confirm, WhatTheRecordingsShowByThemselvesNeedOnlyComeCloser) {
  auto truth = plant::source_axis();
  truth.guide_mass_kg = 90.0;
  tools::Case data;
  data.axis = truth;
  truth.effects.push_back(tests::effect("channel_skew", {{"torque_sensor_delay_s", 0.0}, {"force_sensor_delay_s", 3e-3}}));
  for (const unsigned seed : {1U, 2U})
    data.fit.push_back(
        tests::make_recording(truth, {.motion = "triangle", .duration_s = 4.0, .force_noise_N = 4.0, .seed = seed}));
  for (auto& run : data.fit)
    for (const char* other : {"torque_sensor_Nm", "power_W", "scale_position_m"}) run.channels.erase(other);
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  const ForwardModel forward(data.fit, data);
  Hypothesis by_the_model_alone = hypothesis("channel_skew");
  by_the_model_alone.shown = nullptr;
  for (const auto* skew : {&hypothesis("channel_skew"), &std::as_const(by_the_model_alone)}) {
    SearchResult result;
    result.whitening = fitter.colour_of(model.residual(data.axis, {}));
    Fit fit = fitter.linearised({data.axis, {{skew, {0.0, 3e-3}}}}, result.whitening);
    result.found.emplace_back().effect = fit.model.effects[0];
    keep_confirmed(forward, fitter, result, fit, [](std::string_view) {});
    EXPECT_EQ(result.found.size(), skew->shown != nullptr ? 1U : 0U);
  }
}

}  // namespace
}  // namespace feedtwin
