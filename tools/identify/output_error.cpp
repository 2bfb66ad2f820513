#include "tools/identify/output_error.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "tools/identify/channel_residuals.h"
#include "tools/identify/least_squares.h"
#include "tools/identify/whitening.h"

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double normal_90 = 1.6448536269514722;               // half-width of a 90 % interval in deviations
constexpr double difference_step = 1e-4, largest_step = 0.03;  // of a parameter's scale
constexpr double few_roundings = 3.0;
constexpr double step_deviations = 2.0;  // of an unknown alone, over which differences are taken
constexpr std::size_t block_samples = 200;

/// Residuals of all runs and channels in one column, whitened, then the prior's.
class ResidualStack {
 public:
  ResidualStack(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                const BatchSimulator& simulate, const OutputErrorSettings& settings)
      : runs_(runs), parameters_(parameters), simulate_(simulate), settings_(settings) {
    double squares = 0.0, readings = 0.0;
    rounding_is_left_.assign(runs.size(), false);
    for (const auto& run : runs) {
      const bool metered = run.recording().has(channel::power_W);
      reading_weights_.push_back(reading_weights(run.recording().at(channel::position_m)));
      meters_.push_back(metered ? metered_rows(run.recording(), run.nominal()) : MeteredPower{});
      for (const double value : run.recording().at(channel::power_W)) squares += value * value, readings += 1.0;
    }
    if (squares > 0.0) power_rms_W_ = std::sqrt(squares / readings);
  }

  /// A column for each point; simulated by whoever shares the work.
  MatrixXd operator()(const MatrixXd& points) {
    MatrixXd all(total_rows(), points.cols());
    const auto group = static_cast<Index>(lanes::best_kernel().width);
    const auto [first, last] = settings_.ranks != nullptr ? own_columns(*settings_.ranks, points.cols(), group)
                                                          : std::pair<Index, Index>(0, points.cols());
    if (last > first) all.middleCols(first, last - first) = own(points.middleCols(first, last - first));
    if (settings_.ranks != nullptr) share_columns(*settings_.ranks, all, group);
    simulations_ += static_cast<int>(runs_.size()) * static_cast<int>(points.cols());
    return all;
  }

  /// Learn each channel's weight and colour from what is left at a point.
  void weigh(const VectorXd& point, bool coloured) {
    std::array<std::vector<std::vector<double>>, fitted_channels.size()> stretches;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      auto simulated = simulate_(runs_[r], point);
      auto channels = residuals_of(r, simulated.front());
      for (std::size_t c = 0; c < channels.size() && r == 0; ++c) given_[c] = !channels[c].empty();
      rounding_is_left_[r] = rms(channels[0]) < few_roundings * rounding_Nm(runs_[r]);
      for (std::size_t c = 0; c < channels.size(); ++c) {
        if (!channels[c].empty()) stretches[c].push_back(std::move(channels[c]));
      }
    }
    learn_growth(stretches);
    for (std::size_t c = 0; c < stretches.size(); ++c) {
      whitening_[c] = fit_whitening(stretches[c], coloured ? settings_.whitening_order : 0, smallest_sigma(c));
    }
  }

  [[nodiscard]] Index prior_rows() const { return settings_.prior > 0.0 ? static_cast<Index>(parameters_.size()) : 0; }
  [[nodiscard]] int simulations() const { return simulations_; }
  /// Where one stretch of residuals ends and the next begins, for what is summed in blocks.
  [[nodiscard]] const std::vector<Index>& starts() const { return starts_; }
  /// How many of them each run has; the command comes first.
  [[nodiscard]] std::size_t channels() const { return static_cast<std::size_t>(std::ranges::count(given_, true)); }

 private:
  static double rms(std::span<const double> values) {
    double squares = 0.0;
    for (const double value : values) squares += value * value;
    return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
  }

  /// What the controller, or the stand-in, makes of an encoder's rounding: mostly its derivative's doing.
  static double rounding_Nm(const ClosedLoopRun& run) {
    const auto view = run.view();
    const auto& axis = run.nominal().axis;
    const auto& s = view.stand_in;
    const double share = s.filter_rad_per_s * view.tick_s / (1.0 + s.filter_rad_per_s * view.tick_s);
    const double damping = run.has_controller()
                               ? view.gains.velocity_Ns_per_m
                               : 2.0 * s.damping_ratio * view.stand_in_mass_kg * s.bandwidth_rad_per_s * share;
    const double rounding_m = axis.lead_m / axis.encoder_counts_per_rev / std::sqrt(12.0);
    return damping * std::numbers::sqrt2 * rounding_m / view.tick_s * axis.lead_m / (2.0 * std::numbers::pi);
  }

  /// Where nothing but rounding is left of the command's residual, rows that show the same count are one reading, however
  /// many they are.
  static std::vector<double> reading_weights(std::span<const double> position_m) {
    std::vector<double> weights(position_m.size(), 1.0);
    for (std::size_t first = 0; first < weights.size();) {
      std::size_t end = first + 1;
      while (end < weights.size() && position_m[end] == position_m[first]) ++end;
      std::fill(weights.begin() + static_cast<std::ptrdiff_t>(first), weights.begin() + static_cast<std::ptrdiff_t>(end),
                1.0 / std::sqrt(static_cast<double>(end - first)));
      first = end;
    }
    return weights;
  }

  std::array<std::vector<double>, fitted_channels.size()> residuals_of(std::size_t r, Simulated& simulated) const {
    // effects may come between command and power: of the lanes alone, the paper's model, it is known that none does
    const bool of_lanes = simulated.instant_power_W.empty();
    if (of_lanes && !simulated.power_W.empty()) simulated.power_W = with_recorded_work(runs_[r], simulated);
    return channel_residuals(runs_[r].recording(), meters_[r], simulated);
  }

  MatrixXd own(const MatrixXd& points) {
    MatrixXd all(total_rows(), points.cols());
    Index row = 0;
    for (const auto& run : runs_) {
      const auto r = static_cast<std::size_t>(&run - runs_.data());
      auto simulated = simulate_(run, points);
      Index at = row;
      for (Index p = 0; p < points.cols(); ++p) {
        at = row;
        auto channels = residuals_of(r, simulated[static_cast<std::size_t>(p)]);
        for (std::size_t c = 0; c < channels.size(); ++c) {
          if (fitted_channels[c] == channel::power_W) even_out(r, channels[c]);
          whitening_[c].apply(channels[c]);
          if (fitted_channels[c] == channel::torque_cmd_Nm && rounding_is_left_[r]) {
            for (std::size_t i = 0; i < channels[c].size(); ++i) channels[c][i] *= reading_weights_[r][i];
          }
          std::copy(channels[c].begin(), channels[c].end(), all.col(p).data() + at);
          at += static_cast<Index>(channels[c].size());
        }
      }
      row = at;
    }
    for (Index p = 0; p < points.cols(); ++p) all.col(p).tail(prior_rows()) = prior(points.col(p));
    return all;
  }

  /// A channel cannot be trusted beyond a ten-thousandth of its own size.
  double smallest_sigma(std::size_t c) const {
    if (fitted_channels[c] == channel::scale_position_m) return 1e-9;  // what it is fitted to is not its own size
    double sum = 0.0, count = 0.0;
    for (const auto& run : runs_) {
      for (const double value : run.recording().at(fitted_channels[c])) sum += value * value, count += 1.0;
    }
    return count > 0.0 ? std::max(1e-4 * std::sqrt(sum / count), 1e-12) : 1.0;
  }

  /// A meter's error is partly of its reading: sigma ~ 1 + growth |P| / rms P. The growth under which the residuals are
  /// likeliest, and the residuals evened out by it.
  void learn_growth(std::array<std::vector<std::vector<double>>, fitted_channels.size()>& stretches) {
    const auto at = std::ranges::find(fitted_channels, channel::power_W) - fitted_channels.begin();
    auto& power = stretches[static_cast<std::size_t>(at)];
    if (power.empty()) return;
    const auto original = power;
    double best = std::numeric_limits<double>::infinity(), chosen = 0.0;
    for (const double growth : {0.0, 0.5, 2.0, 8.0, 32.0}) {
      growth_ = growth;
      double squares = 0.0, logarithms = 0.0, count = 0.0;
      for (std::size_t r = 0; r < original.size(); ++r) {
        auto even = original[r];
        even_out(r, even);
        for (std::size_t i = 0; i < even.size(); ++i) {
          squares += even[i] * even[i];
          logarithms += std::log(1.0 + growth * reading(r, i));
          count += 1.0;
        }
      }
      const double unlikely = 0.5 * count * std::log(squares / count + 1e-300) + logarithms;
      if (unlikely < best) best = unlikely, chosen = growth;
    }
    growth_ = chosen;
    for (std::size_t r = 0; r < power.size(); ++r) even_out(r, power[r]);
  }

  /// |P| / rms P of a meter reading.
  double reading(std::size_t run, std::size_t i) const {
    return std::abs(runs_[run].recording().at(channel::power_W)[meters_[run].rows[i]]) / power_rms_W_;
  }

  void even_out(std::size_t run, std::vector<double>& residuals) const {
    if (growth_ > 0.0)
      for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i] /= 1.0 + growth_ * reading(run, i);
  }

  /// All runs give the channels that the first one gave when it was weighed.
  Index total_rows() {
    Index rows = 0;
    starts_.clear();
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      for (std::size_t c = 0; c < fitted_channels.size(); ++c) {
        if (!given_[c]) continue;
        const auto name = fitted_channels[c];
        starts_.push_back(rows);
        const std::size_t recorded = runs_[r].recording().at(name).size();
        rows += static_cast<Index>(name == channel::power_W ? meters_[r].rows.size() : recorded);
      }
    }
    starts_.push_back(rows);
    return rows + prior_rows();
  }

  VectorXd prior(const VectorXd& point) const {
    VectorXd off(prior_rows());
    for (Index i = 0; i < off.size(); ++i) {
      const auto& parameter = parameters_[static_cast<std::size_t>(i)];
      off[i] = (point[i] - parameter.nominal) / (settings_.prior * parameter.prior * parameter.scale);
    }
    return off;
  }

  const std::vector<ClosedLoopRun>& runs_;
  const std::vector<FitParameter>& parameters_;
  const BatchSimulator& simulate_;
  OutputErrorSettings settings_;
  std::vector<MeteredPower> meters_;
  std::vector<std::vector<double>> reading_weights_;  ///< by run and row
  std::array<bool, fitted_channels.size()> given_{};
  std::vector<bool> rounding_is_left_;  ///< by run, when it was weighed
  double power_rms_W_ = 1.0, growth_ = 0.0;
  std::array<Whitening, fitted_channels.size()> whitening_;
  std::vector<Index> starts_;
  int simulations_ = 0;
};

/// Inverse of the information that data and prior hold. What whitening left correlated, or of changing size, is taken up by
/// summing the scores over short times (sandwich), all channels of a run together: an encoder's rounding moves the simulated
/// axis, and with it every channel at once. The wider of the two variances counts.
MatrixXd covariance_of(const LeastSquaresSolution& at, const ResidualStack& stack) {
  const MatrixXd information = at.jacobian.transpose() * at.jacobian;
  const MatrixXd inverse = information.ldlt().solve(MatrixXd::Identity(information.rows(), information.cols()));
  MatrixXd scores = MatrixXd::Zero(information.rows(), information.cols());
  const auto& starts = stack.starts();
  const std::size_t channels = stack.channels();
  for (std::size_t run = 0; run + channels < starts.size(); run += channels) {
    const Index blocks = std::max<Index>((starts[run + 1] - starts[run]) / static_cast<Index>(block_samples), 20);
    for (Index block = 0; block < blocks; ++block) {
      VectorXd score = VectorXd::Zero(information.rows());
      for (std::size_t s = run; s < run + channels; ++s) {
        const Index length = starts[s + 1] - starts[s];
        const Index first = starts[s] + length * block / blocks, end = starts[s] + length * (block + 1) / blocks;
        score += at.jacobian.middleRows(first, end - first).transpose() * at.residuals.segment(first, end - first);
      }
      scores += score * score.transpose();
    }
  }
  const Index data_rows = starts.back();
  const MatrixXd prior_jacobian = at.jacobian.bottomRows(at.jacobian.rows() - data_rows);
  scores += prior_jacobian.transpose() * prior_jacobian;
  const MatrixXd sandwich = inverse * scores * inverse;
  const VectorXd widen = (sandwich.diagonal().array() / inverse.diagonal().array()).max(1.0).sqrt();
  return widen.asDiagonal() * inverse * widen.asDiagonal();
}

/// Differences are taken over about what the data can tell apart: sticking and reversals make the residuals of a short step
/// jump, and a derivative across such a jump would be called knowledge.
void adapt_steps(const LeastSquaresSolution& at, const std::vector<FitParameter>& parameters, VectorXd& step) {
  for (Index i = 0; i < step.size(); ++i) {
    const auto& p = parameters[static_cast<std::size_t>(i)];
    const double alone = 1.0 / std::max(at.jacobian.col(i).norm(), 1e-12);  // deviation with all others known
    step[i] = std::clamp(step_deviations * alone, difference_step * p.scale, largest_step * p.scale);
  }
}

/// Central differences at a solution.
void linearise_centrally(const LeastSquaresProblem& problem, LeastSquaresSolution& at) {
  const Index n = at.point.size();
  MatrixXd points = at.point.replicate(1, 2 * n);
  for (Index i = 0; i < n; ++i) {
    points(i, 2 * i) = std::min(at.point[i] + problem.step[i], problem.highest[i]);
    points(i, 2 * i + 1) = std::max(at.point[i] - problem.step[i], problem.lowest[i]);
  }
  const MatrixXd residuals = problem.residuals(points);
  for (Index i = 0; i < n; ++i) {
    at.jacobian.col(i) = (residuals.col(2 * i) - residuals.col(2 * i + 1)) / (points(i, 2 * i) - points(i, 2 * i + 1));
  }
}

/// Directions in the space of scaled unknowns that the data leave open, each by its largest members.
std::vector<Trade> trades_of(const MatrixXd& covariance, const std::vector<FitParameter>& parameters, double told_below) {
  VectorXd scale(covariance.rows());
  for (Index i = 0; i < scale.size(); ++i) scale[i] = parameters[static_cast<std::size_t>(i)].scale;
  const MatrixXd scaled = scale.cwiseInverse().asDiagonal() * covariance * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  std::vector<Trade> trades;
  for (Index d = scaled.rows() - 1; d >= 0; --d) {
    if (std::sqrt(std::max(eigen.eigenvalues()[d], 0.0)) < told_below) break;
    const VectorXd direction = eigen.eigenvectors().col(d);
    Trade trade;
    for (Index i = 0; i < direction.size(); ++i) {
      if (std::abs(direction[i]) < 0.25) continue;
      trade.keys.push_back(parameters[static_cast<std::size_t>(i)].key);
      trade.weights.push_back(direction[i]);
    }
    trades.push_back(std::move(trade));
  }
  return trades;
}

LeastSquaresProblem problem_for(const std::vector<FitParameter>& parameters, ResidualStack& stack, int most_iterations) {
  const auto n = static_cast<Index>(parameters.size());
  LeastSquaresProblem problem;
  for (auto* vector : {&problem.start, &problem.lowest, &problem.highest, &problem.step}) vector->resize(n);
  for (Index i = 0; i < n; ++i) {
    const auto& p = parameters[static_cast<std::size_t>(i)];
    problem.start[i] = p.start.value_or(p.nominal);
    problem.lowest[i] = p.lowest;
    problem.highest[i] = p.highest;
    problem.step[i] = difference_step * p.scale;
  }
  problem.residuals = [&stack](const MatrixXd& points) { return stack(points); };
  problem.most_iterations = most_iterations;
  return problem;
}

}  // namespace

VectorXd OutputErrorFit::point() const {
  VectorXd values(static_cast<Index>(parameters.size()));
  for (Index i = 0; i < values.size(); ++i) values[i] = parameters[static_cast<std::size_t>(i)].value;
  return values;
}

OutputErrorFit fit_output_error(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                                const BatchSimulator& simulate, const OutputErrorSettings& settings) {
  ResidualStack stack(runs, parameters, simulate, settings);
  LeastSquaresProblem problem = problem_for(parameters, stack, settings.most_iterations);
  LeastSquaresSolution at;
  for (int round = 0; round < settings.rounds; ++round) {
    stack.weigh(problem.start, round > 0);
    at = solve_least_squares(problem);
    if (settings.progress) {
      settings.progress(fmt::format("round {} of {}: {} iterations, weighted rms {:.4f}", round + 1, settings.rounds,
                                    at.iterations, std::sqrt(2.0 * at.cost / static_cast<double>(at.residuals.size()))));
    }
    problem.start = at.point;
    adapt_steps(at, parameters, problem.step);
  }
  linearise_centrally(problem, at);
  OutputErrorFit fit;
  fit.covariance = covariance_of(at, stack);
  fit.trades = trades_of(fit.covariance, parameters, settings.told_below);
  fit.cost = at.cost;
  fit.residuals = static_cast<std::size_t>(at.residuals.size() - stack.prior_rows());
  fit.simulations = stack.simulations();
  fit.converged = at.converged;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto index = static_cast<Index>(i);
    const double deviation = std::sqrt(fit.covariance(index, index));
    const double half = normal_90 * deviation, value = at.point[index];
    const double known = settings.prior > 0.0 ? 0.5 * settings.prior * parameters[i].prior : settings.told_below;
    const bool told = deviation < std::min(settings.told_below, known) * parameters[i].scale;
    fit.parameters.push_back({parameters[i], value, deviation, {value - half, value + half}, told});
  }
  return fit;
}

BatchCost output_error_cost(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                            const BatchSimulator& simulate, const OutputErrorSettings& settings) {
  OutputErrorSettings alone = settings;  // columns are shared here, a cost each
  alone.ranks = nullptr;
  auto stack = std::make_shared<ResidualStack>(runs, parameters, simulate, alone);
  VectorXd start(static_cast<Index>(parameters.size()));
  for (Index i = 0; i < start.size(); ++i) {
    const auto& p = parameters[static_cast<std::size_t>(i)];
    start[i] = p.start.value_or(p.nominal);
  }
  stack->weigh(start, false);
  return [stack, ranks = settings.ranks](const MatrixXd& points) {
    const auto group = static_cast<Index>(lanes::best_kernel().width);
    const auto [first, last] =
        ranks != nullptr ? own_columns(*ranks, points.cols(), group) : std::pair<Index, Index>(0, points.cols());
    MatrixXd costs = MatrixXd::Zero(1, points.cols());
    for (Index at = first; at < last; at += 4 * group) {  // residuals of a few groups at a time are enough memory
      const Index count = std::min(4 * group, last - at);
      costs.middleCols(at, count) = 0.5 * (*stack)(points.middleCols(at, count)).colwise().squaredNorm();
    }
    if (ranks != nullptr) share_columns(*ranks, costs, group);
    return VectorXd(costs.row(0).transpose());
  };
}

}  // namespace feedtwin::tools
