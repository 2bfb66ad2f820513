#include "tools/identify/innovations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace feedtwin::tools {
namespace {

using Stretches = std::vector<std::vector<double>>;

/// Autoregressive noise: r_k = 1.2 r_k-1 - 0.5 r_k-2 + 0.3 e_k, e of Student's t with four degrees of freedom
std::vector<double> coloured(std::size_t samples, unsigned seed) {
  std::mt19937_64 random(seed);
  std::student_t_distribution<double> unit(4.0);
  std::vector<double> r(samples + 200, 0.0);
  for (std::size_t k = 2; k < r.size(); ++k) r[k] = 1.2 * r[k - 1] - 0.5 * r[k - 2] + 0.3 * unit(random);
  return {r.begin() + 200, r.end()};
}

double log_likelihood(const Innovations& of) {
  double sum = 0.0;
  for (const auto& stretch : of.values)
    for (const double e : stretch) sum += of.log_density(e);
  return sum;
}

TEST(Innovations, AreOfTheScaleThatMadeTheNoise) {
  const auto found = innovations_of({coloured(20000, 1), coloured(5000, 2)});
  EXPECT_NEAR(found.scale, 0.3, 0.01);
}

TEST(Innovations, OfHalfTheScaleAreLikelierByALogarithmOfTwoEach) {
  Stretches whole{coloured(20000, 3)}, half = whole;
  for (double& r : half[0]) r *= 0.5;
  EXPECT_NEAR(log_likelihood(innovations_of(half)) - log_likelihood(innovations_of(whole)), 20000 * std::log(2.0), 1.0);
}

// Three single ticks of hundreds of deviations among 20000 rows: worth themselves, and nothing of what the others say.
TEST(Innovations, AFewTicksFarOffSayNothingAboutTheOthers) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Stretches without{coloured(20000, seed)};
    Stretches with = without;
    for (const std::size_t k : {3000U, 9000U, 15000U}) with[0][k] += 60.0;
    const auto calm = innovations_of(without), disturbed = innovations_of(with);
    EXPECT_NEAR(disturbed.scale / calm.scale, 1.0, 0.01) << seed;
    double most = 0.0;
    for (std::size_t k = 10; k < 20000; ++k)
      if (k % 6000 != 3000) most = std::max(most, std::abs(disturbed.values[0][k] - calm.values[0][k]));
    EXPECT_LT(most, 10.0) << "the next rows foresee by what the three are cut to, four scales off; uncut: 240; seed "
                          << seed;
    EXPECT_LT(log_likelihood(calm) - log_likelihood(disturbed), 3 * 40.0) << seed;
  }
}

/// Foretold closely by its past, in bursts not: r_k = 1.96 r_k-1 - 0.9604 r_k-2 + e_k, e of one deviation, of thirty in two
/// hundredths of the time.
std::vector<double> slow_with_bursts(std::size_t samples, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> unit;
  std::vector<double> r(samples + 400, 0.0);
  for (std::size_t k = 2; k < r.size(); ++k)
    r[k] = 1.96 * r[k - 1] - 0.9604 * r[k - 2] + (k % 1000 < 20 ? 30.0 : 1.0) * unit(random);
  return {r.begin() + 400, r.end()};
}

TEST(Innovations, AreNotLostAfterABurst) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Stretches as_made{slow_with_bursts(20000, seed)};
    Stretches nearly = as_made;
    for (double& r : nearly[0]) r *= 1.0 + 1e-6;
    const auto found = innovations_of(as_made);
    EXPECT_GT(found.scale, 0.7) << seed;
    EXPECT_LT(found.scale, 1.5) << seed;
    EXPECT_NEAR(log_likelihood(innovations_of(nearly)), log_likelihood(found), 5.0) << seed;
  }
}

TEST(Innovations, NothingLeftOverIsNoError) {
  const auto found = innovations_of({std::vector<double>(500, 0.0), {}});
  EXPECT_TRUE(std::isfinite(log_likelihood(found)));
}

}  // namespace
}  // namespace feedtwin::tools
