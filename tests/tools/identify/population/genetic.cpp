#include "tools/identify/population/genetic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace feedtwin::tools {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd rastrigin(const MatrixXd& points) {
  return ((points.array().square() - 10.0 * (2.0 * 3.14159265358979 * points.array()).cos()).colwise().sum() +
          10.0 * static_cast<double>(points.rows()))
      .matrix()
      .transpose();
}

const VectorXd lower_corner = VectorXd::Constant(4, -5.0), upper_corner = VectorXd::Constant(4, 4.0);

TEST(Genetic, FindsTheValleyAmongMany) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto found = evolve(lower_corner, upper_corner, rastrigin, {.seed = seed});
    EXPECT_LT(found.cost, 2.0) << "seed " << seed;  // the nearest false valleys lie at 1
    EXPECT_NEAR(found.cost, rastrigin(found.point)[0], 1e-12);
  }
}

TEST(Genetic, TheSameSeedGivesTheSameSearch) {
  const auto a = evolve(lower_corner, upper_corner, rastrigin, {.most_generations = 30, .seed = 3});
  const auto b = evolve(lower_corner, upper_corner, rastrigin, {.most_generations = 30, .seed = 3});
  const auto c = evolve(lower_corner, upper_corner, rastrigin, {.most_generations = 30, .seed = 4});
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.population, b.population);
  EXPECT_NE(a.point, c.point);
}

TEST(Genetic, NeverLeavesItsBoundsNorLosesItsBest) {
  double best_so_far = std::numeric_limits<double>::infinity();
  const auto watched = [&](const MatrixXd& points) {
    EXPECT_TRUE((points.array() >= -5.0).all() && (points.array() <= 4.0).all());
    const VectorXd costs = rastrigin(points);
    best_so_far = std::min(best_so_far, costs.minCoeff());
    return costs;
  };
  const auto found = evolve(lower_corner, upper_corner, watched, {.population = 40, .most_generations = 50});
  EXPECT_EQ(found.cost, best_so_far);
  EXPECT_EQ(found.evaluations, 40 + found.generations * 38) << "the elite of 2 is not asked for again";
}

TEST(Genetic, TakesAStartAndCostsThatAreNotNumbers) {
  const VectorXd start = VectorXd::Constant(4, 1e-6);
  const auto found = evolve(lower_corner, upper_corner, rastrigin, {.population = 20, .most_generations = 3}, start);
  EXPECT_LE(found.cost, rastrigin(start)[0]);
  const auto nowhere = [](const MatrixXd& points) {
    return VectorXd(VectorXd::Constant(points.cols(), std::numeric_limits<double>::quiet_NaN()));
  };
  EXPECT_EQ(evolve(lower_corner, upper_corner, nowhere, {.population = 10, .most_generations = 5}).cost,
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace feedtwin::tools
