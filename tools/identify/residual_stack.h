#pragma once
// Residuals of all runs and channels in one column, whitened, then the prior's: what output error squares and sums.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "tools/identify/channel_residuals.h"
#include "tools/identify/output_error.h"
#include "tools/identify/rests.h"
#include "tools/identify/whitening.h"

namespace feedtwin::tools {

class ResidualStack {
 public:
  /// All of these must outlive it.
  ResidualStack(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                const BatchSimulator& simulate, const OutputErrorSettings& settings);

  /// A column for each point; simulated by whoever shares the work.
  [[nodiscard]] Eigen::MatrixXd operator()(const Eigen::MatrixXd& points);

  /// Learn each channel's weight and colour from what is left at a point. @param bounded as the settings say
  void weigh(const Eigen::VectorXd& point, bool coloured, bool bounded = false);
  /// The weights, colours and meter rows of another stack, for recordings of the same channels and lengths.
  void weigh_as(const ResidualStack& other);

  [[nodiscard]] const std::vector<ClosedLoopRun>& runs() const { return runs_; }
  [[nodiscard]] const std::vector<FitParameter>& parameters() const { return parameters_; }
  [[nodiscard]] const BatchSimulator& simulate() const { return simulate_; }
  [[nodiscard]] const OutputErrorSettings& settings() const { return settings_; }
  [[nodiscard]] const MeteredPower& meter(std::size_t run) const { return meters_[run]; }
  [[nodiscard]] Eigen::Index prior_rows() const {
    return settings_.prior > 0.0 ? static_cast<Eigen::Index>(parameters_.size()) : 0;
  }
  [[nodiscard]] int simulations() const { return simulations_; }
  /// Where one stretch of residuals ends and the next begins, for what is summed in blocks.
  [[nodiscard]] const std::vector<Eigen::Index>& starts() const { return starts_; }
  /// How many of them each run has; the command comes first.
  [[nodiscard]] std::size_t channels() const;

 private:
  using ByChannel = std::array<std::vector<double>, fitted_channels.size()>;

  [[nodiscard]] ByChannel residuals_of(std::size_t run, Simulated& simulated) const;
  [[nodiscard]] double rest_scatter(std::size_t channel, const std::vector<std::vector<double>>& stretches) const;
  void settle(std::size_t run, std::size_t channel, std::vector<double>& residuals) const;
  void bound(std::vector<double>& residuals) const;
  [[nodiscard]] bool only_sliding(std::size_t channel) const;
  [[nodiscard]] std::vector<std::vector<double>> while_told(std::size_t channel,
                                                            std::vector<std::vector<double>> runs) const;
  void whiten(std::size_t run, std::size_t channel, std::vector<double>& residuals) const;
  void limit_events(std::size_t run, std::vector<double>& residuals) const;
  [[nodiscard]] Eigen::MatrixXd own(const Eigen::MatrixXd& points);
  [[nodiscard]] double smallest_sigma(std::size_t channel) const;
  void learn_growth(std::array<std::vector<std::vector<double>>, fitted_channels.size()>& stretches);
  [[nodiscard]] double reading(std::size_t run, std::size_t i) const;
  void even_out(std::size_t run, std::vector<double>& residuals) const;
  [[nodiscard]] Eigen::Index total_rows();
  [[nodiscard]] Eigen::VectorXd prior(const Eigen::VectorXd& point) const;

  const std::vector<ClosedLoopRun>& runs_;
  const std::vector<FitParameter>& parameters_;
  const BatchSimulator& simulate_;
  OutputErrorSettings settings_;
  std::vector<MeteredPower> meters_;
  std::vector<std::vector<double>> reading_weights_;  ///< by run and row
  std::vector<std::vector<Rest>> rests_;              ///< by run
  std::vector<std::vector<bool>> near_rest_;          ///< by run and row
  std::array<double, fitted_channels.size()> rest_scatter_{};
  bool limits_events_ = false, bounded_ = false;
  std::array<bool, fitted_channels.size()> given_{};
  std::vector<bool> rounding_is_left_;  ///< by run, when it was weighed
  double power_rms_W_ = 1.0, growth_ = 0.0;
  std::array<Whitening, fitted_channels.size()> whitening_;
  std::vector<Eigen::Index> starts_;
  int simulations_ = 0;
};

}  // namespace feedtwin::tools
