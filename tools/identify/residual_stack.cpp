#include "tools/identify/residual_stack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tools/identify/innovations.h"
#include "tools/identify/sliding.h"
#include "tools/large_blocks.h"
#include "tools/parallel.h"

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double few_roundings = 3.0;
constexpr double fewest_rests = 4.0;
constexpr std::size_t shortest_rest = 20;  // rows on one count
constexpr double largest_event = 3.0;      // deviations

double rms(std::span<const double> values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
}

/// What the controller, or the stand-in, makes of an encoder's rounding: mostly its derivative's doing.
double rounding_Nm(const ClosedLoopRun& run) {
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

/// A residual at every row, so that a rest's rows can be told.
bool row_by_row(std::size_t channel) {
  return fitted_channels[channel] != channel::power_W;
}

}  // namespace

ResidualStack::ResidualStack(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                             const BatchSimulator& simulate, const OutputErrorSettings& settings)
    : runs_(runs), parameters_(parameters), simulate_(simulate), settings_(settings) {
  double squares = 0.0, readings = 0.0;
  rounding_is_left_.assign(runs.size(), false);
  for (const auto& run : runs) {
    const bool metered = run.recording().has(channel::power_W);
    reading_weights_.push_back(reading_weights(run.recording().at(channel::position_m)));
    rests_.push_back(rests_of(run.recording().at(channel::position_m), shortest_rest));
    near_rest_.push_back(rows_near_rests(run.recording().at(channel::position_m)));
    meters_.push_back(metered ? metered_rows(run.recording(), run.nominal()) : MeteredPower{});
    for (const double value : run.recording().at(channel::power_W)) squares += value * value, readings += 1.0;
  }
  if (squares > 0.0) power_rms_W_ = std::sqrt(squares / readings);
}

MatrixXd ResidualStack::operator()(const MatrixXd& points) {
  const Index rows = total_rows();
  simulations_ += static_cast<int>(runs_.size()) * static_cast<int>(points.cols());
  if (settings_.ranks == nullptr) return own(points);
  MatrixXd all(rows, points.cols());
  const auto group = static_cast<Index>(lanes::best_kernel().width);
  const auto [first, last] = own_columns(*settings_.ranks, points.cols(), group);
  if (last > first) all.middleCols(first, last - first) = own(points.middleCols(first, last - first));
  share_columns(*settings_.ranks, all, group);
  return all;
}

void ResidualStack::weigh(const VectorXd& point, bool coloured, bool bounded) {
  std::array<std::vector<std::vector<double>>, fitted_channels.size()> stretches;
  std::vector<std::vector<Simulated>> simulated(runs_.size());
  parallel_for(runs_.size(), [&](std::size_t r) { simulated[r] = simulate_(runs_[r], point); });
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    auto channels = residuals_of(r, simulated[r].front());
    for (std::size_t c = 0; c < channels.size() && r == 0; ++c) given_[c] = !channels[c].empty();
    rounding_is_left_[r] = rms(channels[0]) < few_roundings * rounding_Nm(runs_[r]);
    for (std::size_t c = 0; c < channels.size(); ++c) stretches[c].push_back(std::move(channels[c]));
  }
  learn_growth(stretches);
  limits_events_ = coloured && settings_.doubt_rests;
  bounded_ = bounded && settings_.largest_deviations > 0.0;
  parallel_for(stretches.size(), [&](std::size_t c) {
    rest_scatter_[c] = limits_events_ && row_by_row(c) ? rest_scatter(c, stretches[c]) : 0.0;
    for (std::size_t r = 0; r < runs_.size(); ++r) settle(r, c, stretches[c][r]);
    const std::size_t order = coloured ? settings_.whitening_order : 0;
    const auto told = while_told(c, std::move(stretches[c]));
    whitening_[c] =
        bounded_ ? innovations_of(told, order, smallest_sigma(c)).colour : fit_whitening(told, order, smallest_sigma(c));
  });
}

void ResidualStack::weigh_as(const ResidualStack& other) {
  given_ = other.given_;
  meters_ = other.meters_;
  rounding_is_left_ = other.rounding_is_left_;
  power_rms_W_ = other.power_rms_W_;
  growth_ = other.growth_;
  limits_events_ = other.limits_events_;
  bounded_ = other.bounded_;
  rest_scatter_ = other.rest_scatter_;
  whitening_ = other.whitening_;
}

std::size_t ResidualStack::channels() const {
  return static_cast<std::size_t>(std::ranges::count(given_, true));
}

ResidualStack::ByChannel ResidualStack::residuals_of(std::size_t run, Simulated& simulated) const {
  // effects may come between command and power: of the lanes alone, the paper's model, it is known that none does
  const bool of_lanes = simulated.instant_power_W.empty();
  if (of_lanes && !simulated.power_W.empty()) simulated.power_W = with_recorded_work(runs_[run], simulated);
  return channel_residuals(runs_[run].recording(), meters_[run], simulated);
}

MatrixXd ResidualStack::own(const MatrixXd& points) {
  MatrixXd all(total_rows(), points.cols());
  ask_for_large_pages(all);
  const std::size_t stretches = channels();
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    auto simulated = simulate_(runs_[r], points);
    const Index first = starts_[r * stretches], end = starts_[(r + 1) * stretches];
    parallel_for(simulated.size(), [&](std::size_t p) {
      Index at = first;
      auto channels = residuals_of(r, simulated[p]);
      for (std::size_t c = 0; c < channels.size(); ++c) {
        if (fitted_channels[c] == channel::power_W) even_out(r, channels[c]);
        settle(r, c, channels[c]);
        whiten(r, c, channels[c]);
        if (row_by_row(c)) limit_events(r, channels[c]);
        if (bounded_) bound(channels[c]);
        if (fitted_channels[c] == channel::torque_cmd_Nm && rounding_is_left_[r]) {
          for (std::size_t i = 0; i < channels[c].size(); ++i) channels[c][i] *= reading_weights_[r][i];
        }
        // never beyond what this run was said to have
        const auto count = std::min(static_cast<Index>(channels[c].size()), end - at);
        std::copy_n(channels[c].begin(), count, all.col(static_cast<Index>(p)).data() + at);
        at += count;
      }
    });
  }
  for (Index p = 0; p < points.cols(); ++p) all.col(p).tail(prior_rows()) = prior(points.col(p));
  return all;
}

/// Where the axis rests, the simulated one rests somewhere else within the count, and as long as that lasts every row is off
/// by the same: one reading of a random offset. Its deviation beside that of a row's own noise; 0 where there is none.
double ResidualStack::rest_scatter(std::size_t channel, const std::vector<std::vector<double>>& stretches) const {
  double offsets = 0.0, rests = 0.0, within = 0.0, freedom = 0.0, shares = 0.0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (stretches[r].size() != runs_[r].recording().size()) continue;
    for (const Rest& rest : rests_[r]) {
      const double mean = mean_over(stretches[r], rest), count = static_cast<double>(rest.end - rest.first);
      for (std::size_t i = rest.first; i < rest.end; ++i) within += (stretches[r][i] - mean) * (stretches[r][i] - mean);
      freedom += count - 1.0;
      offsets += mean * mean;
      shares += 1.0 / count;
      rests += 1.0;
    }
  }
  if (rests < fewest_rests || within <= 0.0) return 0.0;
  const double noise = std::max(within / freedom, std::pow(smallest_sigma(channel), 2));
  return std::sqrt(std::max(offsets / rests / noise - shares / rests, 0.0));
}

/// Each rest's mean weighed by what it is worth beside the rows' own scatter.
void ResidualStack::settle(std::size_t run, std::size_t channel, std::vector<double>& residuals) const {
  if (rest_scatter_[channel] <= 0.0 || residuals.size() != runs_[run].recording().size()) return;
  for (const Rest& rest : rests_[run]) {
    const double count = static_cast<double>(rest.end - rest.first);
    const double kept = 1.0 / std::sqrt(1.0 + count * rest_scatter_[channel] * rest_scatter_[channel]);
    const double mean = mean_over(residuals, rest);
    for (std::size_t i = rest.first; i < rest.end; ++i) residuals[i] -= (1.0 - kept) * mean;
  }
}

/// The tick in which the axis sets off, or sticks, is known to a tick at best, and in it a sensor sees the motor's friction
/// come or go: a step by many deviations. How many ticks it is off by tells little, that it is off tells nothing more.
void ResidualStack::limit_events(std::size_t run, std::vector<double>& residuals) const {
  if (!limits_events_ || residuals.size() != near_rest_[run].size()) return;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (near_rest_[run][i]) residuals[i] = std::clamp(residuals[i], -largest_event, largest_event);
  }
}

bool ResidualStack::only_sliding(std::size_t channel) const {
  return settings_.torque_sensor_while_sliding && fitted_channels[channel] == channel::torque_sensor_Nm;
}

/// All stretches of all runs of a channel that is read only while the axis slides; of any other the runs as they are.
std::vector<std::vector<double>> ResidualStack::while_told(std::size_t channel,
                                                           std::vector<std::vector<double>> runs) const {
  if (!only_sliding(channel)) return runs;
  std::vector<std::vector<double>> told;
  for (std::size_t r = 0; r < runs.size() && given_[channel]; ++r)
    for (const auto& [first, end] : stretches_of(runs_[r].motor_slides()))
      told.emplace_back(runs[r].begin() + static_cast<std::ptrdiff_t>(first),
                        runs[r].begin() + static_cast<std::ptrdiff_t>(end));
  return told;
}

void ResidualStack::whiten(std::size_t run, std::size_t channel, std::vector<double>& residuals) const {
  if (!only_sliding(channel) || !given_[channel]) return whitening_[channel].apply(residuals);
  std::vector<double> white(residuals.size(), 0.0);
  for (const auto& [first, end] : stretches_of(runs_[run].motor_slides())) {
    const auto told = std::span(residuals).subspan(first, end - first);
    whitening_[channel].apply(told);
    std::ranges::copy(told, white.begin() + static_cast<std::ptrdiff_t>(first));
  }
  residuals = std::move(white);
}

/// e^2 / 2 -> c^2 (sqrt(1 + (e / c)^2) - 1), as the square of what is returned
void ResidualStack::bound(std::vector<double>& residuals) const {
  const double c = settings_.largest_deviations;
  for (double& e : residuals) e = std::copysign(c * std::sqrt(2.0 * (std::sqrt(1.0 + (e / c) * (e / c)) - 1.0)), e);
}

/// A channel cannot be trusted beyond a ten-thousandth of its own size.
double ResidualStack::smallest_sigma(std::size_t channel) const {
  if (fitted_channels[channel] == channel::scale_position_m) return 1e-9;  // what it is fitted to is not its own size
  double sum = 0.0, count = 0.0;
  for (const auto& run : runs_) {
    for (const double value : run.recording().at(fitted_channels[channel])) sum += value * value, count += 1.0;
  }
  return count > 0.0 ? std::max(1e-4 * std::sqrt(sum / count), 1e-12) : 1.0;
}

/// A meter's error is partly of its reading: sigma ~ 1 + growth |P| / rms P. The growth under which the residuals are
/// likeliest, and the residuals evened out by it.
void ResidualStack::learn_growth(std::array<std::vector<std::vector<double>>, fitted_channels.size()>& stretches) {
  const auto at = std::ranges::find(fitted_channels, channel::power_W) - fitted_channels.begin();
  auto& power = stretches[static_cast<std::size_t>(at)];
  if (std::ranges::all_of(power, [](const auto& readings) { return readings.empty(); })) return;
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
double ResidualStack::reading(std::size_t run, std::size_t i) const {
  return std::abs(runs_[run].recording().at(channel::power_W)[meters_[run].rows[i]]) / power_rms_W_;
}

void ResidualStack::even_out(std::size_t run, std::vector<double>& residuals) const {
  for (std::size_t i = 0; growth_ > 0.0 && i < residuals.size(); ++i) residuals[i] /= 1.0 + growth_ * reading(run, i);
}

/// All runs give the channels that the first one gave when it was weighed.
Index ResidualStack::total_rows() {
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

VectorXd ResidualStack::prior(const VectorXd& point) const {
  VectorXd off(prior_rows());
  for (Index i = 0; i < off.size(); ++i) {
    const auto& parameter = parameters_[static_cast<std::size_t>(i)];
    off[i] = (point[i] - parameter.nominal) / (settings_.prior * parameter.prior * parameter.scale);
  }
  return off;
}

}  // namespace feedtwin::tools
