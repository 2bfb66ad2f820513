#include "tools/identify/power_meter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedtwin::tools {
namespace {

constexpr int laws = 7;  // idle, |v| and v^2 by direction, copper, work
using Laws = Eigen::Array<double, laws, 1>;

/// What a tick's power may be made of (Eqs. 7 and 11, and the copper loss that they leave out).
Laws laws_of(double torque_Nm, double v, double rad_per_m) {
  const double forth = v > 0.0 ? 1.0 : 0.0, back = 1.0 - forth;
  Laws all;
  all << 1.0, forth * std::abs(v), back * std::abs(v), forth * v * v, back * v * v, torque_Nm * torque_Nm,
      torque_Nm * rad_per_m * v;
  return all;
}

/// Rms of what these laws leave over of the readings, however large each is; no readings: nothing.
double unexplained_W(const Recording& recording, const MeteredPower& meter, const plant::AxisParameters& axis) {
  const auto command = recording.at(channel::torque_cmd_Nm);
  const auto position = recording.at(channel::position_m), power_W = recording.at(channel::power_W);
  const auto readings = static_cast<Eigen::Index>(meter.rows.size());
  if (readings < 3 * laws || command.empty() || position.empty()) return 0.0;
  Eigen::MatrixXd rows(readings, laws);
  Eigen::VectorXd shown(readings);
  for (Eigen::Index i = 0; i < readings; ++i) {
    const std::size_t row = meter.rows[static_cast<std::size_t>(i)], first = meter.first_tick(row);
    Laws sum = Laws::Zero();
    for (std::size_t k = first; k < std::min(first + meter.window, position.size() - 1); ++k)
      sum += laws_of(command[k], (position[k + 1] - position[k]) / recording.sample_s, 2.0 * std::numbers::pi / axis.axis.lead_m);
    rows.row(i) = sum / static_cast<double>(meter.window);
    shown[i] = power_W[row];
  }
  const Eigen::VectorXd size = rows.colwise().norm().cwiseMax(1e-300);
  rows = rows * size.cwiseInverse().asDiagonal();
  const Eigen::VectorXd left = shown - rows * rows.colPivHouseholderQr().solve(shown);
  return left.norm() / std::sqrt(static_cast<double>(readings));
}

}  // namespace

MeteredPower metered_rows(std::span<const double> power_W, std::size_t expected_window) {
  MeteredPower meter;
  for (std::size_t i = 1; i < power_W.size(); ++i) {
    if (power_W[i] != power_W[i - 1]) meter.rows.push_back(i);
  }
  std::vector<std::size_t> spacing;
  for (std::size_t i = 1; i < meter.rows.size(); ++i) spacing.push_back(meter.rows[i] - meter.rows[i - 1]);
  if (spacing.size() >= 3) {
    const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
    std::nth_element(spacing.begin(), middle, spacing.end());
    meter.window = *middle;
  } else {  // the meter showed the same all along, as over an axis at rest: its window is known from elsewhere
    meter.window = std::max<std::size_t>(expected_window, 1);
    const std::size_t first = meter.rows.empty() ? power_W.size() : meter.rows.front();
    meter.rows.clear();
    for (std::size_t row = first; row < power_W.size(); row += meter.window) meter.rows.push_back(row);
  }
  if (meter.window < 5) {  // not held: every row is a reading of its own
    meter.window = 1;
    meter.rows.resize(power_W.size());
    for (std::size_t i = 0; i < power_W.size(); ++i) meter.rows[i] = i;
  }
  std::erase_if(meter.rows, [&meter](std::size_t row) { return row + 1 < meter.window; });
  return meter;
}

MeteredPower metered_rows(const Recording& recording, const plant::AxisParameters& axis) {
  const auto power_W = recording.at(channel::power_W);
  if (power_W.empty()) return {};
  const double window = std::round(axis.power_meter_window_s / recording.sample_s);
  MeteredPower meter = metered_rows(power_W, static_cast<std::size_t>(window));
  if (meter.window == 1) return meter;
  MeteredPower late = meter;
  late.delay = 1;
  std::erase_if(late.rows, [&late](std::size_t row) { return row < late.window; });
  constexpr double clearly = 0.5;
  return unexplained_W(recording, late, axis) < clearly * unexplained_W(recording, meter, axis) ? late : meter;
}

std::vector<double> as_metered(std::span<const double> power_W, const MeteredPower& meter) {
  std::vector<double> shown(power_W.size());
  double now_W = 0.0;
  auto next = meter.rows.begin();
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (next != meter.rows.end() && *next == i) {
      double sum = 0.0;
      const std::size_t first = meter.first_tick(i);
      for (std::size_t j = first; j < first + meter.window; ++j) sum += power_W[j];
      now_W = sum / static_cast<double>(meter.window);
      ++next;
    }
    shown[i] = now_W;
  }
  return shown;
}

}  // namespace feedtwin::tools
