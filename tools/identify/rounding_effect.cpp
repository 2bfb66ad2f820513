#include "tools/identify/rounding_effect.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tools/parallel.h"

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What would have been recorded of a simulated run, without the sensors' noise, through a grid that stands `phase` of a
/// count beside the run's own.
Recording recorded_through_grid(const ClosedLoopRun& run, const MeteredPower& meter, const Simulated& simulated,
                                double phase) {
  const auto& axis = run.nominal().axis;
  const double count_m = axis.lead_m / axis.encoder_counts_per_rev;
  Recording made = run.recording();
  for (const auto name : fitted_channels) {
    const auto found = made.channels.find(name);
    const auto model = simulated_channel(simulated, name);
    if (found == made.channels.end() || model.empty()) continue;
    if (name == channel::power_W) {
      found->second = as_metered(model, meter);
    } else {
      found->second.assign(model.begin(), model.end());
    }
  }
  auto& position_m = made.channels.at(std::string(channel::position_m));
  for (std::size_t i = 0; i < position_m.size(); ++i)
    position_m[i] = (std::round(simulated.position_m[i] / count_m + phase) - phase) * count_m;
  return made;
}

}  // namespace

MatrixXd rounding_effect(const LeastSquaresSolution& at, const MatrixXd& inverse, const ResidualStack& stack, int grids) {
  const Index unknowns = at.point.size(), data_rows = at.residuals.size() - stack.prior_rows();
  if (grids < 2) return MatrixXd::Zero(unknowns, unknowns);
  const auto& runs = stack.runs();
  std::vector<Simulated> truths;
  for (const auto& run : runs) {
    if (run.has_controller()) return MatrixXd::Zero(unknowns, unknowns);
    truths.push_back(std::move(stack.simulate()(run, at.point).front()));
  }
  std::mt19937_64 random(1);  // NOLINT(bugprone-random-generator-seed): the same answer for the same input
  std::uniform_real_distribution<double> phase(-0.5, 0.5);
  MatrixXd phases(static_cast<Index>(runs.size()), grids), moved(unknowns, grids);
  for (double& value : phases.reshaped()) value = phase(random);
  auto settings = stack.settings();
  settings.ranks = nullptr;
  parallel_for(static_cast<std::size_t>(grids), [&](std::size_t grid) {
    std::vector<Recording> recordings;
    std::vector<ClosedLoopRun> made;
    recordings.reserve(runs.size());
    for (std::size_t r = 0; r < runs.size(); ++r) {
      recordings.push_back(recorded_through_grid(runs[r], stack.meter(r), truths[r],
                                                 phases(static_cast<Index>(r), static_cast<Index>(grid))));
      made.emplace_back(recordings.back(), runs[r].nominal(), std::nullopt, runs[r].view().stand_in);
    }
    ResidualStack through_grid(made, stack.parameters(), stack.simulate(), settings);
    through_grid.weigh_as(stack);
    const VectorXd residuals = through_grid(at.point).col(0).head(data_rows);
    moved.col(static_cast<Index>(grid)) = -inverse * (at.jacobian.topRows(data_rows).transpose() * residuals);
  });
  return moved * moved.transpose() / grids;
}

}  // namespace feedtwin::tools
