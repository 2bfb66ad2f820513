#include "tools/diagnose/planning/separation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/feed_axis.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/identify/channel_residuals.h"
#include "tools/linear_systems.h"
#include "tools/loopback/tracking_gains.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t block = 5, order = 12;
/// The encoder's grid would make two simulations differ by chance; the chance is in the residual's colour already.
constexpr double finer_encoder = 64.0;
/// What is known of the numbers, as a deviation, is known less well than the fit says.
constexpr double doubt = 2.0;
/// Noise of sensors that are not there yet.
constexpr double scale_noise_m = 5e-8;

using Series = std::map<std::string, std::vector<double>, std::less<>>;

std::vector<double> means_over(std::span<const double> values, std::size_t length) {
  std::vector<double> out;
  for (std::size_t i = 0; i + length <= values.size(); i += length) {
    double sum = 0.0;
    for (std::size_t j = i; j < i + length; ++j) sum += values[j];
    out.push_back(sum / static_cast<double>(length));
  }
  return out;
}

/// The colour of a channel's remainder over all runs; structure in it counts as noise, and bursts are white noise too.
tools::Whitening colour_of(const std::vector<std::vector<double>>& stretches) {
  double square = 0.0, count = 0.0;
  for (const auto& stretch : stretches)
    for (const double r : stretch) square += r * r, count += 1.0;
  return fit_whitening(stretches, order, 0.2 * std::sqrt(square / std::max(1.0, count)) + 1e-12);
}

plant::AxisParameters axis_of(const Move& move, const Candidate& model) {
  auto axis = without_stops(extended(model).common);
  axis.guide_mass_kg += move.more_on_table_kg;
  axis.axis.encoder_counts_per_rev *= finer_encoder;
  if (!move.process_runs) std::erase_if(axis.effects, [](const auto& e) { return e.id.starts_with("process_force"); });
  for (auto& effect : axis.effects)
    if (effect.id == "count_loss") effect.values.front() *= finer_encoder;
  return axis;
}

Series recorded_by(const Move& move, const plant::AxisParameters& parameters, const controllers::CascadeGains& gains,
                   double fastest_m_per_s, double sample_s) {
  const auto kinds = controllers::motion_kinds();
  const auto kind = std::ranges::find(kinds, move.motion, &controllers::MotionKind::name);
  const auto motion = kind->make(settings_of(move, parameters, fastest_m_per_s));
  plant::FeedAxis axis(parameters);
  axis.place(motion->at(0.0).position_m);
  controllers::Cascade cascade(gains);
  cascade.reset(motion->at(0.0).position_m);
  Series all;
  auto &torque = all["torque_cmd_Nm"], &torque_sensor = all["torque_sensor_Nm"], &force = all["force_sensor_N"],
       &slip = all["scale_position_m"], &power = all["power_W"];
  const auto ticks = static_cast<std::size_t>(move.duration_s / sample_s);
  for (std::size_t k = 0; k < ticks; ++k) {
    const auto& now = axis.signals();
    const double shown_m = axis.encoder().position_m(now.encoder_counts);
    const auto wanted = motion->at(static_cast<double>(k) * sample_s);
    const plant::AxisCommand command{.torque_Nm = cascade.torque_Nm(wanted, shown_m, sample_s),
                                     .setpoint_m_per_s = wanted.velocity_m_per_s};
    const auto sensed = axis.force_sensors(command);
    torque.push_back(command.torque_Nm);
    torque_sensor.push_back(sensed.torque_sensor_Nm);
    force.push_back(sensed.force_sensor_N);
    slip.push_back(now.scale_position_m - shown_m);
    power.push_back(axis.step(command, sample_s).power_W);
  }
  return all;
}

void add_white(std::span<const double> values, std::size_t length, const tools::Whitening& colour,
               std::vector<double>& out) {
  auto means = means_over(values, length);
  colour.apply(means);
  out.insert(out.end(), means.begin(), means.end());
}

}  // namespace

double chance_to_tell(double distance) {
  constexpr double odds = 20.0;
  if (!(distance > 0.0)) return 0.0;
  return 0.5 * std::erfc(-(0.5 * distance - std::log(odds) / distance) / std::numbers::sqrt2);
}

Separation::Separation(const ForwardModel& forward, const Fitter& fitter, const Candidate& present,
                       const std::optional<controllers::CascadeGains>& controller)
    : fitter_(&fitter), gains_(controller.value_or(tracking_gains(present.axis))) {
  std::map<std::string, std::vector<std::vector<double>>, std::less<>> left;
  const auto simulated = forward.simulate(extended(present));
  for (std::size_t r = 0; r < simulated.size(); ++r) {
    const Recording& recording = forward.runs()[r].recording();
    sample_s_ = recording.sample_s;
    const auto residuals = channel_residuals(recording, metered_rows(recording, forward.runs()[r].nominal()), simulated[r]);
    for (std::size_t c = 0; c < fitted_channels.size(); ++c) {
      if (residuals[c].empty()) continue;
      const bool metered = fitted_channels[c] == channel::power_W;
      left[std::string(fitted_channels[c])].push_back(metered ? residuals[c] : means_over(residuals[c], block));
    }
    const auto position = recording.at(channel::position_m);
    for (std::size_t k = 20; k < position.size(); k += 20)
      fastest_m_per_s_ = std::max(fastest_m_per_s_, std::abs(position[k] - position[k - 20]) / (20.0 * sample_s_));
  }
  for (const auto& [name, stretches] : left) colour_.emplace(name, colour_of(stretches));
}

Vector Separation::shown(const Move& move, const Candidate& model) const {
  const auto parameters = axis_of(move, model);
  const auto all = recorded_by(move, parameters, gains_, fastest_m_per_s_, sample_s_);
  const auto window = static_cast<std::size_t>(std::lround(parameters.power_meter_window_s / sample_s_));
  std::vector<double> white;
  for (const auto& [name, colour] : colour_)
    add_white(all.at(name), name == channel::power_W ? std::max<std::size_t>(1, window) : block, colour, white);
  // a new sensor sees what the command's remainder is made of, and noise of its own
  const tools::Whitening& like_torque = colour_.at("torque_cmd_Nm");
  if (move.extra == Extra::torque_sensor && !colour_.contains("torque_sensor_Nm"))
    add_white(all.at("torque_sensor_Nm"), block, like_torque, white);
  if (move.extra == Extra::force_sensor && !colour_.contains("force_sensor_N")) {
    auto like_force = like_torque;
    like_force.sigma *= 2.0 * std::numbers::pi / parameters.axis.lead_m;
    add_white(all.at("force_sensor_N"), block, like_force, white);
  }
  if (move.extra == Extra::scale && !colour_.contains("scale_position_m"))
    add_white(all.at("scale_position_m"), block, {.coefficients = {}, .sigma = scale_noise_m}, white);
  return Eigen::Map<const Vector>(white.data(), static_cast<Index>(white.size()));
}

double Separation::distance(const Move& move, const Candidate& truth, const Contender& other, bool bent) const {
  std::vector<Candidate> models{truth, other.model};
  const auto deviation = [&other](Index i) { return std::sqrt(std::max(0.0, other.covariance(i, i))); };
  if (bent) {  // a column a number, for one deviation of it
    Index next = 0;
    for (std::size_t i = 0; i < fitter_->base().size(); ++i, ++next) {
      const auto& p = fitter_->base()[i];
      models.push_back(other.model);
      set_value(p, models.back().axis, value_of(p, other.model.axis) + deviation(next) * fitter_->tolerance(i));
    }
    for (std::size_t e = 0; e < other.model.effects.size(); ++e)
      for (std::size_t j = 0; j < other.model.effects[e].q.size(); ++j) {
        const auto& p = other.model.effects[e].hypothesis->parameters[j];
        if (!fitted(p.kind)) continue;
        models.push_back(other.model);
        auto& q = models.back().effects[e].q[j];
        q = std::clamp(q + deviation(next++), p.lowest, p.highest);
      }
  }
  std::vector<Vector> seen(models.size());
  parallel_for(models.size(), [&](std::size_t i) { seen[i] = shown(move, models[i]); });
  const Vector apart = seen[0] - seen[1];
  const double square = apart.squaredNorm();
  if (!bent) return std::sqrt(square);
  const auto n = static_cast<Index>(models.size() - 2);
  Eigen::MatrixXd bends(apart.size(), n), correlation(n, n);
  for (Index i = 0; i < n; ++i) bends.col(i) = seen[static_cast<std::size_t>(i) + 2] - seen[1];
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      correlation(i, j) = other.covariance(i, j) / std::max(1e-300, deviation(i) * deviation(j)) + (i == j ? 1e-9 : 0.0);
  // (1 + J C J^T)^-1 by Woodbury, so that only as many rows are solved for as there are numbers
  const Eigen::MatrixXd known = inverse_of(doubt * doubt * correlation);
  const Vector along = bends.transpose() * apart;
  const double taken = along.dot(solved(known + bends.transpose() * bends, along));
  return std::sqrt(std::max(0.0, square - taken));
}

}  // namespace feedtwin::tools::diagnosis
