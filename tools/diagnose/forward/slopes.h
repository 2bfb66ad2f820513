#pragma once
// How a run's simulated channels move with the numbers of the nominal model, kept from one polish to the next. Beside
// another effect they are nearly what they were, and every step that they propose is simulated before it is taken: so a
// rival's polish simulates its own few numbers anew, not some forty. The effects' own numbers are kept too, for a first
// glance at one effect more.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tools/identify/closed_loop.h"

namespace feedtwin::tools::diagnosis {

class Slopes {
 public:
  using Simulator = std::function<std::vector<Simulated>(const Eigen::MatrixXd& points)>;

  explicit Slopes(std::size_t runs) : by_run_(runs) {}

  /// What forward differences show: points (columns) a step beside the first one, each in an unknown of its own. Of other
  /// points nothing is learned.
  void learn(std::size_t run, const Eigen::MatrixXd& points, const std::vector<Simulated>& simulated);

  /// One result for each point. Of forward differences those in the first `shared` unknowns, the same as when the slopes
  /// were learned, are not simulated.
  [[nodiscard]] std::vector<Simulated> simulated(std::size_t run, const Eigen::MatrixXd& points, Eigen::Index shared,
                                                 const Simulator& simulate) const;

 private:
  std::vector<std::vector<Simulated>> by_run_;  ///< by unknown: the channels' change per unit
};

}  // namespace feedtwin::tools::diagnosis
