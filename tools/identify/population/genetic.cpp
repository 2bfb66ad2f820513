#include "tools/identify/population/genetic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Draws that do not depend on the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 bits_;
};

void sort_by_cost(MatrixXd& population, VectorXd& costs) {
  std::vector<Index> order(static_cast<std::size_t>(costs.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&costs](Index i) { return costs[i]; });
  const MatrixXd points = population;
  const VectorXd values = costs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    population.col(static_cast<Index>(i)) = points.col(order[i]);
    costs[static_cast<Index>(i)] = values[order[i]];
  }
}

/// Stochastic universal sampling on 1 / sqrt(rank), in random order.
std::vector<Index> select_parents(Index population, std::size_t count, Random& random) {
  double total = 0.0;
  for (Index i = 0; i < population; ++i) total += 1.0 / std::sqrt(static_cast<double>(i) + 1.0);
  const double stride = total / static_cast<double>(count);
  std::vector<Index> parents;
  double at = random.uniform() * stride, up_to = 1.0;
  for (Index i = 0; parents.size() < count;) {
    if (at <= up_to || i + 1 == population) {
      parents.push_back(i);
      at += stride;
    } else {
      ++i;
      up_to += 1.0 / std::sqrt(static_cast<double>(i) + 1.0);
    }
  }
  for (std::size_t i = parents.size(); i > 1; --i)
    std::swap(parents[i - 1], parents[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  return parents;
}

VectorXd finite(VectorXd costs) {
  for (double& cost : costs) {
    if (!std::isfinite(cost)) cost = std::numeric_limits<double>::infinity();
  }
  return costs;
}

}  // namespace

GeneticResult evolve(const VectorXd& lowest, const VectorXd& highest, const BatchCost& cost, const GeneticSettings& settings,
                     const VectorXd& start) {
  const Index unknowns = lowest.size(), population = std::max(settings.population, 4);
  const int most = settings.most_generations > 0 ? settings.most_generations : 100 * static_cast<int>(unknowns);
  const auto elite =
      std::max<Index>(1, static_cast<Index>(std::ceil(settings.elite_share * static_cast<double>(population))));
  const auto crossed = static_cast<Index>(std::lround(settings.crossover_share * static_cast<double>(population - elite)));
  const VectorXd range = highest - lowest;
  Random random(settings.seed);
  GeneticResult result;
  MatrixXd points(unknowns, population);
  for (double& value : points.reshaped()) value = random.uniform();
  points = (range.asDiagonal() * points).colwise() + lowest;
  if (start.size() == unknowns) points.col(0) = start.cwiseMax(lowest).cwiseMin(highest);
  VectorXd costs = finite(cost(points));
  result.evaluations = population;
  sort_by_cost(points, costs);
  std::vector<double> best_by_generation{costs[0]};
  for (int generation = 0; generation < most; ++generation) {
    MatrixXd next = points;  // the elite stays in front
    const auto parents =
        select_parents(population, static_cast<std::size_t>(2 * crossed + population - elite - crossed), random);
    const double shrunk = 1.0 - static_cast<double>(generation) / most;
    for (Index child = elite, parent = 0; child < population; ++child) {
      const auto first = parents[static_cast<std::size_t>(parent++)];
      if (child - elite < crossed) {
        const auto second = parents[static_cast<std::size_t>(parent++)];
        for (Index i = 0; i < unknowns; ++i) next(i, child) = points(i, random.uniform() < 0.5 ? first : second);
      } else {
        for (Index i = 0; i < unknowns; ++i) next(i, child) = points(i, first) + shrunk * range[i] * random.normal();
        next.col(child) = next.col(child).cwiseMax(lowest).cwiseMin(highest);
      }
    }
    costs.tail(population - elite) = finite(cost(next.rightCols(population - elite)));
    result.evaluations += population - elite;
    points = std::move(next);
    sort_by_cost(points, costs);
    result.generations = generation + 1;
    best_by_generation.push_back(costs[0]);
    const auto past = static_cast<std::ptrdiff_t>(best_by_generation.size()) - 1 - settings.stall_generations;
    if (past >= 0) {
      const double before = best_by_generation[static_cast<std::size_t>(past)];
      if (before - costs[0] <= settings.tolerance * std::abs(costs[0])) break;
    }
  }
  result.point = points.col(0);
  result.cost = costs[0];
  result.population = std::move(points);
  result.costs = std::move(costs);
  return result;
}

}  // namespace feedtwin::tools
