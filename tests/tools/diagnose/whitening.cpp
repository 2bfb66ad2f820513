// The residual's colour: noise is, what an effect leaves over is not.

#include "tools/diagnose/whitening.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "tests/support/made_case.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// By rms, the noise that is found in white noise of 1 N and forces that turn with the direction of motion.
/// @param force_N by the share of the run that is over, and by the place
double noise_found_N(const std::function<double(double, double)>& force_N) {
  const tools::Case data = tests::short_case(plant::source_axis(), plant::source_axis());
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  std::mt19937_64 random(7);
  std::normal_distribution<double> white;
  Vector residual(model.rows());
  for (const auto& s : model.segments())
    for (Index i = 0; i < s.size; ++i) {
      const Track& track = model.tracks()[s.run];
      const Index k = model.sample_of(s, i);
      const double direction = track.centred_m_per_s[k] > 0.0 ? 1.0 : -1.0;
      const double over = static_cast<double>(k) / static_cast<double>(track.size);
      residual[s.start + i] = white(random) + direction * force_N(over, track.shown_m[k]);
    }
  return Whitening::estimate(model, residual).residual_rms(0);
}

TEST(Whitening, WhatGoesSteadilyWithTimeOrPlaceIsNoNoise) {
  EXPECT_NEAR(noise_found_N([](double, double) { return 0.0; }), 1.0, 0.1);
  EXPECT_NEAR(noise_found_N([](double, double) { return 20.0; }), 1.0, 0.1);
  EXPECT_NEAR(noise_found_N([](double over, double) { return 20.0 * (1.0 - over); }), 1.0, 0.1);
  EXPECT_NEAR(noise_found_N([](double, double at_m) { return 2000.0 * at_m; }), 1.0, 0.1);
}

// A play that is taken up a moment early leaves spikes in what the scale shows: they are a law's mistake, and must not
// outweigh all else by what is small between them.
TEST(Whitening, SpikesOfTheScaleAreNoReasonToTakeItsNoiseForNothing) {
  const auto run = tests::make_recording(plant::source_axis(), {.scale_at_table = true});
  const InverseModel model(make_tracks({run}, plant::source_axis()), plant::source_axis());
  std::mt19937_64 random(7);
  std::normal_distribution<double> white;
  Vector residual(model.rows());
  for (Index k = 0; k < residual.size(); ++k) residual[k] = 1e-9 * white(random) + (k % 20 == 0 ? 1e-7 : 0.0);
  const Vector whitened = Whitening::estimate(model, residual).applied(model, residual);
  double squares = 0.0, rows = 0.0;
  for (const auto& s : model.segments())
    if (model.equations()[s.equation].slip)
      squares += whitened.segment(s.start, s.size).squaredNorm(), rows += static_cast<double>(s.size);
  ASSERT_GT(rows, 0.0);
  EXPECT_LT(std::sqrt(squares / rows), 1.6);
}

// Rows are whitened some at a time: an impulse answers as if alone, wherever in a run it stands, and no run hears another.
TEST(Whitening, TheAnswerToAnImpulseIsTheSameInEveryRow) {
  const tools::Case data = tests::short_case(plant::source_axis(), plant::source_axis());
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  std::mt19937_64 random(8);
  std::normal_distribution<double> white;
  Vector coloured(model.rows());
  double last = 0.0;
  for (double& value : coloured) value = last = 0.8 * last + white(random);
  const Whitening whitening = Whitening::estimate(model, coloured);
  const Segment& first = model.segments().front();
  const auto answer = [&](Index row) -> Vector {
    Vector impulse = Vector::Zero(model.rows());
    impulse[row] = 1.0;
    return whitening.applied(model, impulse);
  };
  const auto weight = [&](Index row) { return answer(row)[row]; };  // settled or not
  constexpr Index long_enough = 14;
  const Index middle = first.start + first.size / 2;
  const Vector expected = answer(middle);
  for (Index row = first.start + first.size - 2 * long_enough; row < first.start + first.size; ++row) {
    const Vector found = answer(row);
    EXPECT_EQ(found.head(row).cwiseAbs().maxCoeff(), 0.0);
    const Index end = first.start + first.size;
    EXPECT_EQ(found.tail(model.rows() - end).cwiseAbs().maxCoeff(), 0.0) << "in another run";
    for (Index k = 0; k < std::min(long_enough, end - row); ++k)
      EXPECT_NEAR(found[row + k] / weight(row + k), expected[middle + k] / weight(middle + k), 1e-12)
          << "row " << row << " + " << k;
  }
  EXPECT_LT(expected[middle + 1] / weight(middle + 1), -0.5) << "the colour is not taken off";
}

}  // namespace
}  // namespace feedtwin
