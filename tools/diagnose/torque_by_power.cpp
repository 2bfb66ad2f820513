#include "tools/diagnose/torque_by_power.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// The power equation's rows of all runs. @param contacts friction, of which the power knows nothing: followed once
Vector power_rows(const InverseModel& model, const Candidate& at, const std::vector<ContactForces>& contacts) {
  const Vector all = model.residual(at.axis, at.effects, contacts);
  std::vector<double> rows;
  for (const auto& s : model.segments())
    if (model.equations()[s.equation].power) rows.insert(rows.end(), all.data() + s.start, all.data() + s.start + s.size);
  return Eigen::Map<const Vector>(rows.data(), static_cast<Index>(rows.size()));
}

}  // namespace

std::optional<TorqueByPower> torque_by_power(const Fitter& fitter, const Candidate& model) {
  constexpr double step = 0.01;  // in all that it tells the power is linear
  constexpr Index least_rows_a_number = 4;
  const auto& inverse = fitter.model();
  if (!inverse.power_recorded() || inverse.tracks().front().meter.of_command) return std::nullopt;
  const auto contacts = inverse.contacts(model.axis, model.effects);
  const Vector left = power_rows(inverse, model, contacts);
  std::vector<Vector> columns;
  for (const auto& number : fitter.base()) {
    if (!number.only_power) continue;
    Candidate more = model;
    set_value(number, more.axis, value_of(number, model.axis) + step);
    columns.push_back((left - power_rows(inverse, more, contacts)) / step);
  }
  Candidate more = model;
  more.effects.push_back({&hypothesis("torque_gain_error"), {step}});
  columns.push_back((left - power_rows(inverse, more, contacts)) / step);
  const auto count = static_cast<Index>(columns.size());
  if (left.size() < least_rows_a_number * count) return std::nullopt;
  Eigen::MatrixXd rows(left.size(), count);
  for (Index c = 0; c < count; ++c) rows.col(c) = columns[static_cast<std::size_t>(c)];
  const Vector found = least_squares(rows, left);
  const double variance = (left - rows * found).squaredNorm() / static_cast<double>(left.size() - count);
  const Eigen::MatrixXd covariance = inverse_of(rows.transpose() * rows) * variance;
  return TorqueByPower{found[count - 1], std::sqrt(std::max(0.0, covariance(count - 1, count - 1)))};
}

bool denied_by_power(const Fitter& fitter, const Candidate& model, std::size_t effect) {
  // of true ones it was within 4 %; false ones were off by half of their size and more
  constexpr double clearly_off = 0.3, surely_deviations = 2.4;
  const Active& named = model.effects[effect];
  if (named.hypothesis != &hypothesis("torque_gain_error")) return false;
  const auto by_power = torque_by_power(fitter, without(model, effect));
  if (!by_power) return false;
  const double off = std::abs(named.q.front() - by_power->relative_error);
  return off > clearly_off * std::abs(named.q.front()) && off > surely_deviations * by_power->deviation;
}

}  // namespace feedtwin::tools::diagnosis
