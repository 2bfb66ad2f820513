#pragma once
// Output error on forward closed-loop simulation: the parameters under which the simulated command, sensors and power come
// closest to the recorded ones, with intervals that know of the residuals' colour, and with what the data cannot tell.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tools/identify/closed_loop.h"
#include "tools/identify/population/genetic.h"
#include "tools/identify/population/shared_columns.h"

namespace feedtwin::tools {

/// One unknown.
struct FitParameter {
  std::string key;       ///< of plant/parameter_table, or of an effect
  double nominal = 0.0;  ///< middle of the prior, and the start where none is given
  double lowest = 0.0, highest = 0.0;
  double scale = 1.0;  ///< > 0: differences are taken in 1e-4 of it, and the prior's deviation is `prior` of it
  double prior = 1.0;  ///< times the settings' prior
  std::optional<double> start{};
};

/// Simulates one run for several sets of unknowns (a column each). Every channel that the recording has, but the scale.
using BatchSimulator = std::function<std::vector<Simulated>(const ClosedLoopRun& run, const Eigen::MatrixXd& points)>;

struct OutputErrorSettings {
  /// Deviation of a wide prior around the nominal values, in units of `scale`: holds what the data cannot tell. 0: none.
  double prior = 0.5;
  /// An unknown is told by the data when its deviation is below this share of its scale and below half of the prior's.
  double told_below = 0.15;
  std::size_t whitening_order = 24;
  /// Rows at rest and about it count by what an encoder's rounding leaves of them: a rest's mean as one reading, the ticks
  /// of sticking and setting off by a few deviations at most. Not where what is missing may act at rest.
  bool doubt_rests = true;
  /// The motor's Coulomb friction sets in within some micrometres; how, Eq. 1 does not say, and until it has, the torque
  /// sensor tells how the motor's friction and the screw's share what they hold, and nothing else.
  bool torque_sensor_while_sliding = false;
  /// After the first round, a row that is off by more deviations than this counts by the root of its size only
  /// (pseudo-Huber): the tick in which an axis sticks or sets off is chance. 0: every row by its square.
  double largest_deviations = 0.0;
  int encoder_grids = 32;            ///< that the effect of the encoder's rounding is seen on; fewer than 2: it is left out
  int rounds = 3;                    ///< of fitting and weighing anew
  bool coloured_from_start = false;  ///< else the first round takes the residuals for white
  bool intervals = true;             ///< else the covariance is left out, and its simulations with it
  int most_iterations = 25;
  int kept_steps = 0;          ///< for simulators without lanes; this and the next: see LeastSquaresProblem
  double least_fall = 0.0;     ///< of the cost, in nats
  Eigen::Index asked = 0;      ///< in the first round; this and the next: see LeastSquaresProblem
  double least_promise = 0.0;  ///< in nats
  double behind_nats = 0.0;    ///< in the first round; see LeastSquaresProblem
  std::function<void(int round)> round_begins = {};
  const Ranks* ranks = nullptr;                           ///< who shares the simulations; nullptr: nobody
  std::function<void(const std::string& line)> progress;  ///< told of every round; may be empty
};

struct FittedParameter {
  FitParameter parameter;
  double value = 0.0, deviation = 0.0;
  double ci90[2] = {0.0, 0.0};
  bool identifiable = false;
  double degrees_of_freedom = std::numeric_limits<double>::infinity();  ///< of the deviation
  /// Holds with those of all other numbers of the axis at once in 90 % of repeats (joint_intervals.h); identify gives it.
  std::optional<std::array<double, 2>> joint_ci90{};
};

/// Unknowns of which the data tell only one combination.
struct Trade {
  std::vector<std::string> keys;
  std::vector<double> weights;  ///< the direction that costs nothing, in units of the parameters' scales
};

struct OutputErrorFit {
  std::vector<FittedParameter> parameters;
  Eigen::MatrixXd covariance;
  std::vector<Trade> trades;
  double cost = 0.0;  ///< half the sum of whitened squares
  std::size_t residuals = 0;
  int simulations = 0;  ///< runs simulated, each for one set
  bool converged = false;

  [[nodiscard]] Eigen::VectorXd point() const;
};

/// @param runs at least one. Channels are weighed by what each one's residuals turn out to be.
[[nodiscard]] OutputErrorFit fit_output_error(const std::vector<ClosedLoopRun>& runs,
                                              const std::vector<FitParameter>& parameters, const BatchSimulator& simulate,
                                              const OutputErrorSettings& settings = {});

/// Where a first round of fitting ends from each of several starts, a column each.
[[nodiscard]] Eigen::MatrixXd first_fits(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                                         const BatchSimulator& simulate, const Eigen::MatrixXd& starts,
                                         const OutputErrorSettings& settings = {});

/// Half the sum of squares for each point, with channels weighed by what is left at the parameters' start: for a population,
/// or to choose between starts. What it refers to must outlive it.
[[nodiscard]] BatchCost output_error_cost(const std::vector<ClosedLoopRun>& runs,
                                          const std::vector<FitParameter>& parameters, const BatchSimulator& simulate,
                                          const OutputErrorSettings& settings = {});

}  // namespace feedtwin::tools
