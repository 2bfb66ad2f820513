#include "tools/identify/inverse_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/axis_model.h"
#include "tools/identify/zero_phase_filter.h"
#include "tools/linear_systems.h"

namespace feedtwin::tools {
namespace {

/// Below this the filtered velocity is the encoder's grid, not motion.
constexpr double at_rest_m_per_s = 2e-6;

}  // namespace

RecordedMotion recorded_motion(const Recording& recording, double lead_m, const InverseModelSettings& settings) {
  const double sample_s = recording.sample_s, nyquist_Hz = 0.5 / sample_s;
  const auto position =
      filter_both_ways(butterworth(4, std::min(0.9, settings.cutoff_Hz / nyquist_Hz)), recording.at(channel::position_m));
  const auto velocity = central_difference(position, sample_s);
  const auto acceleration = central_difference(velocity, sample_s);
  const std::size_t skip = std::min(settings.lead_in_samples, recording.size() / 10);
  const auto command = recording.at(channel::torque_cmd_Nm);
  std::vector<double> torque_Nm(command.begin(), command.end());
  for (std::size_t i = torque_Nm.size(); settings.held_command && i-- > 1;)
    torque_Nm[i] = 0.5 * (command[i] + command[i - 1]);
  const auto after = [skip](std::span<const double> values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(skip), values.end());
  };
  RecordedMotion motion{after(position), after(velocity), after(acceleration), after(torque_Nm), 1};
  for (double& force : motion.force_N) force *= 2.0 * std::numbers::pi / lead_m;
  motion.decimation = decimation_keeping(settings.band_Hz, sample_s);
  return motion;
}

RigidFit fit_rigid_model(const RecordedMotion& motion, bool directional) {
  const std::size_t n = motion.velocity_m_per_s.size();
  std::vector<std::vector<double>> columns{motion.acceleration_m_per_s2};
  std::vector<double> sign(n), forth(n), back(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double v = motion.velocity_m_per_s[i];
    sign[i] = v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0;
    forth[i] = std::max(v, 0.0);
    back[i] = std::min(v, 0.0);
  }
  if (directional) {
    columns.insert(columns.end(), {forth, back});
  } else {
    columns.push_back(motion.velocity_m_per_s);
  }
  columns.push_back(sign);
  columns.emplace_back(n, 1.0);
  const auto force = decimated(motion.force_N, motion.decimation);
  const auto rows = static_cast<Eigen::Index>(force.size()), width = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd regressors(rows, width);
  for (Eigen::Index c = 0; c < width; ++c) {
    const auto column = decimated(columns[static_cast<std::size_t>(c)], motion.decimation);
    regressors.col(c) = Eigen::Map<const Eigen::VectorXd>(column.data(), rows);
  }
  const Eigen::Map<const Eigen::VectorXd> measured(force.data(), rows);
  const Eigen::VectorXd solution = least_squares(regressors, measured);
  const Eigen::VectorXd model = regressors * solution;
  const double variance = (measured - model).squaredNorm() / static_cast<double>(rows);
  const Eigen::MatrixXd inverse = inverse_of(regressors.transpose() * regressors);
  const Eigen::VectorXd deviation = (variance * inverse.diagonal()).cwiseMax(0.0).cwiseSqrt();
  RigidFit fit;
  const Eigen::Index second = directional ? 2 : 1;
  double* const values[] = {&fit.mass_kg, &fit.viscous_pos_Ns_per_m, &fit.viscous_neg_Ns_per_m, &fit.coulomb_N,
                            &fit.offset_N};
  const Eigen::Index sources[] = {0, 1, second, second + 1, second + 2};
  for (std::size_t i = 0; i < 5; ++i) {
    *values[i] = solution[sources[i]];
    fit.deviation[i] = deviation[sources[i]];
  }
  fit.relative_error = (measured - model).norm() / measured.norm();
  fit.force_N = force;
  fit.model_N.assign(model.data(), model.data() + model.size());
  return fit;
}

std::vector<double> inverse_force_N(const plant::AxisParameters& axis, const RecordedMotion& motion, double sample_s) {
  const auto model = plant::make_axis_model(axis);
  const double per_sample_Hz = 1.0 / sample_s;
  double screw_bristle_m = 0.0, guide_bristle_m = 0.0;
  std::vector<double> force_N(motion.velocity_m_per_s.size());
  for (std::size_t i = 0; i < force_N.size(); ++i) {
    const double v = motion.velocity_m_per_s[i], speed = std::abs(v);
    const bool positive = v > 0.0;
    const auto contacts =
        model.contacts.step({positive ? 1.0 : -1.0, speed, sample_s, per_sample_Hz}, screw_bristle_m, guide_bristle_m, {});
    screw_bristle_m = contacts.screw_bristle_m;
    guide_bristle_m = contacts.guide_bristle_m;
    const double coulomb = speed < at_rest_m_per_s ? 0.0 : positive ? model.coulomb_pos_N : -model.coulomb_neg_N;
    const double damping = positive ? model.damping_pos_Ns_per_m : model.damping_neg_Ns_per_m;
    force_N[i] = model.mass_kg * motion.acceleration_m_per_s2[i] + coulomb + damping * v + contacts.screw_force_N +
                 contacts.guide_force_N;
  }
  return force_N;
}

}  // namespace feedtwin::tools
