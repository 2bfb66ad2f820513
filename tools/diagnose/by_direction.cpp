#include "tools/diagnose/by_direction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/diagnose/reported.h"
#include "tools/diagnose/sentence.h"
#include "tools/intervals.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double least_deviations = 6.0, least_share = 0.02;

/// A friction's sum over the components, forth less back, and how it goes with the base parameters.
struct Difference {
  double forth = 0.0, back = 0.0;
  Vector slope;

  [[nodiscard]] double value() const { return forth - back; }
  [[nodiscard]] double deviation(const Eigen::MatrixXd& covariance) const {
    return std::sqrt(std::max(0.0, slope.dot(covariance * slope)));
  }
  [[nodiscard]] bool shows(const Eigen::MatrixXd& covariance) const {
    return std::abs(value()) > least_share * 0.5 * (forth + back) &&
           std::abs(value()) > least_deviations * deviation(covariance);
  }
};

/// @param kind "coulomb" or what viscous friction is called: "viscous" of the contacts, "damping" of the motor
bool is_of(std::string_view key, std::string_view kind) {
  return key.find("." + std::string(kind) + "_") != std::string_view::npos;
}

/// Does the axis file have one number for both directions of this? Each number for forth is followed by that for back.
bool same_both_ways(const Fitter& fitter, std::size_t i) {
  const bool forth = fitter.base()[i].entry->key.find("_pos_") != std::string_view::npos;
  const std::size_t other = forth ? i + 1 : i - 1;
  return value_of(fitter.base()[i], fitter.nominal()) == value_of(fitter.base()[other], fitter.nominal());
}

/// Of the components whose friction the file does not tell by direction, or of one of them.
Difference difference(const Fitter& fitter, const Fit& fit, Index unknowns, bool coulomb, std::string_view component = "") {
  Difference sum{.slope = Vector::Zero(unknowns)};
  const double rad_per_m = 2.0 * std::numbers::pi / fit.model.axis.axis.lead_m;
  for (std::size_t i = 0; i < fitter.base().size(); ++i) {
    const auto& parameter = fitter.base()[i];
    const auto key = parameter.entry->key;
    const bool motor = is_of(key, "damping");
    if (coulomb ? !is_of(key, "coulomb") : !is_of(key, "viscous") && !motor) continue;
    if (!same_both_ways(fitter, i) || !key.starts_with(component)) continue;
    const double to_table = motor ? rad_per_m * rad_per_m : 1.0;
    const bool forth = key.find("_pos_") != std::string_view::npos;
    (forth ? sum.forth : sum.back) += to_table * value_of(parameter, fit.model.axis);
    sum.slope[static_cast<Index>(i)] = (forth ? 1.0 : -1.0) * to_table * fitter.tolerance(i);
  }
  return sum;
}

Estimate estimate(const Difference& difference, const Eigen::MatrixXd& covariance) {
  const double half = for_the_laws * normal_90 * difference.deviation(covariance);
  return {difference.value(), difference.value() - half, difference.value() + half};
}

/// A constant force that in motion is the same: a torque's offset where the difference may be the motor's, a weight's share
/// where it may be the guide's. A sensor tells whose it is.
std::vector<std::string> constant_forces(const Fitter& fitter, const Fit& fit, Index unknowns) {
  constexpr double most_of_it = 0.7;
  const double all = difference(fitter, fit, unknowns, true).value();
  const auto share = [&](std::string_view component) {
    return difference(fitter, fit, unknowns, true, component).value() / all;
  };
  const Track& track = fitter.model().tracks().front();
  const bool torque = track.torque_sensor_N.size() > 0, force = track.force_sensor_N.size() > 0;
  const double behind_motor = share("motor"), behind_screw = behind_motor + share("ball_screw");
  std::vector<std::string> found;
  if (torque ? behind_motor > most_of_it : !force || behind_screw > most_of_it) found.emplace_back("torque_offset");
  if (force ? behind_screw < 1.0 - most_of_it : !torque || behind_motor < 1.0 - most_of_it) found.emplace_back("gravity");
  return found;
}

}  // namespace

std::optional<NamedEffect> difference_by_direction(const Fitter& fitter, const Fit& fit, const Eigen::MatrixXd& covariance) {
  const Hypothesis& own = hypothesis("direction_dependent_friction");
  if (has(fit.model, own)) return std::nullopt;
  const Difference coulomb = difference(fitter, fit, covariance.rows(), true);
  const Difference viscous = difference(fitter, fit, covariance.rows(), false);
  if (!coulomb.shows(covariance) && !viscous.shows(covariance)) return std::nullopt;
  const double gain = std::max(std::pow(coulomb.value() / coulomb.deviation(covariance), 2),
                               std::pow(viscous.value() / viscous.deviation(covariance), 2));
  NamedEffect effect = held_by_numbers(own, gain, fit);
  effect.parameters = {{"coulomb_difference_N", estimate(coulomb, covariance)},
                       {"viscous_difference_Ns_per_m", estimate(viscous, covariance)}};
  double fastest = 0.0;
  for (const auto& track : fitter.model().tracks()) fastest = std::max(fastest, track.centred_m_per_s.cwiseAbs().maxCoeff());
  effect.intervals = {{-fastest, fastest}};
  if (!viscous.shows(covariance)) effect.alternatives = constant_forces(fitter, fit, covariance.rows());
  effect.sentence =
      sentence_of(effect) + " The axis file has one number for both; the recalibrated ones hold the difference.";
  return effect;
}

}  // namespace feedtwin::tools::diagnosis
