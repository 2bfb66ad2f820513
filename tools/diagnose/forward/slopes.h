#pragma once
// How a run's simulated channels move with the numbers of the nominal model, kept from one polish to the next. Beside
// another effect they are nearly what they were, and every step that they propose is simulated before it is taken: so a
// rival's polish simulates its own few numbers anew, not some forty.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tools/identify/closed_loop.h"

namespace feedtwin::tools::diagnosis {

class Slopes {
 public:
  using Simulator = std::function<std::vector<Simulated>(const Eigen::MatrixXd& points)>;

  /// @param numbers of the nominal model: the first unknowns of every point
  Slopes(std::size_t runs, Eigen::Index numbers) : numbers_(numbers), by_run_(runs) {}

  /// What forward differences show: points (columns) a step beside the first one, each in an unknown of its own. Of other
  /// points nothing is learned.
  void learn(std::size_t run, const Eigen::MatrixXd& points, const std::vector<Simulated>& simulated);

  /// One result for each point. Of forward differences those in a number whose slopes are known are not simulated.
  [[nodiscard]] std::vector<Simulated> simulated(std::size_t run, const Eigen::MatrixXd& points,
                                                 const Simulator& simulate) const;

 private:
  Eigen::Index numbers_;
  std::vector<std::vector<Simulated>> by_run_;  ///< by number: the channels' change per unit
};

}  // namespace feedtwin::tools::diagnosis
