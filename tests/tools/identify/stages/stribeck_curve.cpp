#include "tools/identify/stages/stribeck_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tools/identify/stages/by_genetic.h"
#include "tools/identify/stages/line_search.h"

namespace feedtwin::tools {
namespace {

double logarithmic(std::mt19937_64& random, double lowest, double highest) {
  return std::exp(std::uniform_real_distribution<double>(std::log(lowest), std::log(highest))(random));
}

StribeckFit draw(std::mt19937_64& random) {
  StribeckFit truth;
  truth.coulomb_N = logarithmic(random, 1.0, 100.0);
  truth.static_N = truth.coulomb_N * logarithmic(random, 1.1, 2.0);
  truth.stribeck_m_per_s = logarithmic(random, 3e-4, 5e-3);
  truth.viscous_Ns_per_m = truth.coulomb_N * logarithmic(random, 1.0, 30.0);
  return truth;
}

StribeckCurve curve_of(const StribeckFit& truth, std::size_t points, double noise_N, std::mt19937_64& random) {
  std::normal_distribution<double> unit;
  StribeckCurve curve;
  for (std::size_t i = 0; i < points; ++i) {
    const double v = 1e-4 * std::pow(1500.0, static_cast<double>(i) / static_cast<double>(points - 1));
    curve.speed_m_per_s.push_back(v);
    curve.force_N.push_back(truth.force_N(v) + noise_N * unit(random));
    curve.weight.push_back(1.0);
  }
  return curve;
}

TEST(StribeckCurve, GivesBackAnyExactCurve) {
  std::mt19937_64 random(61);
  for (int round = 0; round < 500; ++round) {
    const StribeckFit truth = draw(random);
    SCOPED_TRACE(testing::Message() << truth.coulomb_N << ' ' << truth.static_N << ' ' << truth.stribeck_m_per_s << ' '
                                    << truth.viscous_Ns_per_m);
    const auto fit = fit_stribeck_curve(curve_of(truth, 200, 0.0, random));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->coulomb_N, truth.coulomb_N, 1e-5 * truth.coulomb_N);
    EXPECT_NEAR(fit->static_N, truth.static_N, 1e-5 * truth.static_N);
    EXPECT_NEAR(fit->stribeck_m_per_s, truth.stribeck_m_per_s, 1e-4 * truth.stribeck_m_per_s);
    EXPECT_NEAR(fit->viscous_Ns_per_m, truth.viscous_Ns_per_m, 1e-4 * truth.viscous_Ns_per_m);
  }
}

// No other set within the bounds does better: neither a random one nor a neighbour.
TEST(StribeckCurve, NothingNearOrFarIsBetter) {
  std::mt19937_64 random(62);
  for (int round = 0; round < 50; ++round) {
    const StribeckFit truth = draw(random);
    const auto curve = curve_of(truth, 60, 0.1 * truth.coulomb_N, random);
    const auto fit = fit_stribeck_curve(curve);
    ASSERT_TRUE(fit);
    EXPECT_GE(fit->static_N, fit->coulomb_N);
    EXPECT_GE(fit->viscous_Ns_per_m, 0.0);
    const auto cost = [&curve](const StribeckFit& at) {
      double sum = 0.0;
      for (std::size_t i = 0; i < curve.force_N.size(); ++i)
        sum += std::pow(at.force_N(curve.speed_m_per_s[i]) - curve.force_N[i], 2);
      return sum;
    };
    EXPECT_NEAR(cost(*fit), fit->cost, 1e-6 * fit->cost);
    for (int trial = 0; trial < 200; ++trial) {
      StribeckFit other = trial % 2 == 0 ? draw(random) : *fit;
      if (trial % 2 == 1) {
        std::normal_distribution<double> small(0.0, 0.01);
        other.coulomb_N *= 1.0 + small(random);
        other.static_N = std::max(other.coulomb_N, other.static_N * (1.0 + small(random)));
        other.stribeck_m_per_s *= 1.0 + small(random);
        other.viscous_Ns_per_m *= 1.0 + small(random);
      }
      other.stribeck_m_per_s = std::clamp(other.stribeck_m_per_s, 1e-4 / 3.0, 0.15 / 3.0);
      ASSERT_GE(cost(other), fit->cost * (1.0 - 1e-6)) << "round " << round << " trial " << trial;
    }
  }
}

TEST(StribeckCurve, KeepsItsBoundsOnCurvesThatRiseOrFallAlone) {
  StribeckCurve falling, rising;
  for (int i = 0; i < 30; ++i) {
    const double v = 1e-3 * (i + 1);
    falling.speed_m_per_s.push_back(v), falling.force_N.push_back(10.0 - 100.0 * v), falling.weight.push_back(1.0);
    rising.speed_m_per_s.push_back(v), rising.force_N.push_back(10.0 + 100.0 * v), rising.weight.push_back(1.0);
  }
  const auto down = fit_stribeck_curve(falling), up = fit_stribeck_curve(rising);
  ASSERT_TRUE(down && up);
  EXPECT_EQ(down->viscous_Ns_per_m, 0.0);
  EXPECT_GE(down->static_N, down->coulomb_N);
  EXPECT_NEAR(up->coulomb_N, 10.0, 1e-3);
  EXPECT_NEAR(up->viscous_Ns_per_m, 100.0, 0.1);
}

TEST(StribeckCurve, AsksForEnoughPoints) {
  EXPECT_FALSE(fit_stribeck_curve({}));
  EXPECT_FALSE(fit_stribeck_curve({{1e-3, 2e-3, 3e-3, 4e-3, 5e-3}, {1, 1, 1, 1, 1}, {1, 1, 1, 1, 1}}));
  EXPECT_FALSE(fit_stribeck_curve({{1, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1}})) << "one speed";
}

// The reference method agrees, and is no better.
TEST(StribeckCurve, TheGeneticAlgorithmIsNoBetter) {
  std::mt19937_64 random(63);
  for (int round = 0; round < 3; ++round) {
    const StribeckFit truth = draw(random);
    const auto curve = curve_of(truth, 60, 0.02 * truth.coulomb_N, random);
    const auto fit = fit_stribeck_curve(curve);
    const auto genetic = fit_stribeck_curve_by_genetic(curve, {.seed = static_cast<std::uint64_t>(round + 1)});
    ASSERT_TRUE(fit && genetic);
    EXPECT_GE(genetic->cost, fit->cost * (1.0 - 1e-9));
    EXPECT_LT(genetic->cost, 3.0 * fit->cost);
  }
}

TEST(BinnedCurve, KeepsTheMeanOfEverySample) {
  std::mt19937_64 random(64);
  std::vector<double> speed, force;
  for (int i = 0; i < 5000; ++i) {
    speed.push_back(logarithmic(random, 1e-4, 0.1));
    force.push_back(3.0 + 50.0 * speed.back());
  }
  const auto curve = binned_curve(speed, force, 200);
  EXPECT_LE(curve.speed_m_per_s.size(), 200U);
  double samples = 0.0, sum = 0.0, all = 0.0;
  for (std::size_t i = 0; i < curve.force_N.size(); ++i)
    samples += curve.weight[i], sum += curve.weight[i] * curve.force_N[i];
  for (const double f : force) all += f;
  EXPECT_EQ(samples, 5000.0);
  EXPECT_NEAR(sum, all, 1e-9 * all);
}

TEST(LowestPoint, FindsTheDeepestValley) {
  const auto two_valleys = [](double x) { return std::pow(x * x - 1.0, 2) + 0.1 * x; };
  EXPECT_NEAR(lowest_point(two_valleys, -3.0, 3.0, 9), -1.0124, 1e-3);
  int calls = 0;
  const auto parabola = [&calls](double x) { return ++calls, (x - 0.3) * (x - 0.3); };
  EXPECT_NEAR(lowest_point(parabola, -1.0, 1.0, 5), 0.3, 1e-6);
  EXPECT_LT(calls, 25);
  EXPECT_NEAR(lowest_point([](double x) { return x; }, 2.0, 5.0, 7), 2.0, 1e-6) << "at an end";
}

}  // namespace
}  // namespace feedtwin::tools
