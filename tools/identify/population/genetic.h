#pragma once
// The genetic algorithm of the source (section 3.2: MATLAB's toolbox, with its documented defaults): rank scaling,
// stochastic uniform selection, elite of 5 %, scattered crossover for 80 % of the rest, Gaussian mutation that shrinks over
// the generations. A whole generation is asked for at once, so that its costs can come from lanes and from other processes.
//
// The reference method: it needs no derivative and no start, and many evaluations.

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace feedtwin::tools {

/// One cost for each column of points; what is not finite counts as infinitely bad.
using BatchCost = std::function<Eigen::VectorXd(const Eigen::MatrixXd& points)>;

struct GeneticSettings {
  int population = 200;
  int most_generations = 0;  ///< 0: 100 for each unknown
  int stall_generations = 50;
  double tolerance = 1e-6;  ///< relative gain over the stall below which the search ends
  double elite_share = 0.05, crossover_share = 0.8;
  std::uint64_t seed = 1;
};

struct GeneticResult {
  Eigen::VectorXd point;
  double cost = 0.0;
  int generations = 0;
  long evaluations = 0;
  Eigen::MatrixXd population;  ///< the last one, best first
  Eigen::VectorXd costs;
};

/// @param start a point that the first generation holds beside its random ones; may be empty
/// The same result for the same seed and costs, whoever computed them.
[[nodiscard]] GeneticResult evolve(const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest, const BatchCost& cost,
                                   const GeneticSettings& settings = {}, const Eigen::VectorXd& start = {});

}  // namespace feedtwin::tools
