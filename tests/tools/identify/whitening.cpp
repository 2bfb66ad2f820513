#include "tools/identify/whitening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace feedtwin::tools {
namespace {

/// Autoregressive noise: r_k = 1.2 r_k-1 - 0.5 r_k-2 + 0.3 e_k
std::vector<double> coloured(std::size_t samples, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> unit;
  std::vector<double> r(samples + 200, 0.0);
  for (std::size_t k = 2; k < r.size(); ++k) r[k] = 1.2 * r[k - 1] - 0.5 * r[k - 2] + 0.3 * unit(random);
  return {r.begin() + 200, r.end()};
}

double correlation(std::span<const double> values, std::size_t lag) {
  double at_lag = 0.0, at_zero = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    at_zero += values[k] * values[k];
    if (k >= lag) at_lag += values[k] * values[k - lag];
  }
  return at_lag / at_zero;
}

TEST(Whitening, FindsTheColourThatMadeTheNoise) {
  const std::vector stretches{coloured(20000, 1), coloured(5000, 2)};
  const auto whitening = fit_whitening(stretches, 2, 1e-9);
  ASSERT_EQ(whitening.coefficients.size(), 2U);
  EXPECT_NEAR(whitening.coefficients[0], 1.2, 0.03);
  EXPECT_NEAR(whitening.coefficients[1], -0.5, 0.03);
  EXPECT_NEAR(whitening.sigma, 0.3, 0.01);
}

TEST(Whitening, LeavesWhiteNoiseOfUnitSize) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::vector<double> r = coloured(20000, seed);
    EXPECT_GT(correlation(r, 1), 0.7);
    fit_whitening(std::vector<std::vector<double>>{r}, 24, 1e-9).apply(r);
    for (std::size_t lag = 1; lag < 10; ++lag)
      EXPECT_NEAR(correlation(r, lag), 0.0, 0.03) << "seed " << seed << " lag " << lag;
    double squares = 0.0;
    for (const double e : r) squares += e * e;
    EXPECT_NEAR(squares / static_cast<double>(r.size()), 1.0, 0.03);
  }
}

TEST(Whitening, OrderZeroOnlyWeighs) {
  std::vector<double> r{3.0, -4.0};
  const auto whitening = fit_whitening(std::vector<std::vector<double>>{r}, 0, 1e-9);
  EXPECT_TRUE(whitening.coefficients.empty());
  whitening.apply(r);
  EXPECT_NEAR(r[0], 3.0 / std::sqrt(12.5), 1e-6);
}

TEST(Whitening, TakesNothingAndZeros) {
  EXPECT_EQ(fit_whitening({}, 24, 0.5).sigma, 0.5);
  const auto none = fit_whitening(std::vector<std::vector<double>>{std::vector<double>(1000, 0.0)}, 24, 0.5);
  EXPECT_EQ(none.sigma, 0.5);
  EXPECT_TRUE(none.coefficients.empty());
  const auto few = fit_whitening(std::vector<std::vector<double>>{std::vector<double>{1.0, 2.0, 1.0}}, 24, 1e-9);
  EXPECT_TRUE(few.coefficients.empty()) << "three samples tell no colour";
}

// Whatever the length beside the order: sample by sample what the formula says.
TEST(Whitening, IsTheFormulaForAnyLength) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> unit;
  for (int round = 0; round < 200; ++round) {
    Whitening whitening;
    whitening.coefficients.resize(std::uniform_int_distribution<std::size_t>(0, 30)(random));
    for (double& a : whitening.coefficients) a = unit(random);
    whitening.sigma = std::exp(unit(random));
    std::vector<double> r(std::uniform_int_distribution<std::size_t>(0, 1600)(random));
    for (double& value : r) value = unit(random);
    std::vector<double> white = r;
    whitening.apply(white);
    for (std::size_t k = 0; k < r.size(); ++k) {
      double e = r[k], size = std::abs(r[k]);
      for (std::size_t i = 1; i <= std::min(k, whitening.coefficients.size()); ++i) {
        e -= whitening.coefficients[i - 1] * r[k - i];
        size += std::abs(whitening.coefficients[i - 1] * r[k - i]);
      }
      ASSERT_NEAR(white[k], e / whitening.sigma, 1e-14 * size / whitening.sigma)
          << "row " << k << " of " << r.size() << ", order " << whitening.coefficients.size();
    }
  }
}

}  // namespace
}  // namespace feedtwin::tools
