#include "tools/identify/stages/electrical_loss.h"

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <numbers>

#include "tools/identify/closed_loop.h"

namespace feedtwin::tools {
namespace {

constexpr int unknowns = 5;  // k_e0, k_e1 and k_e2 in either direction

/// Means over one window of the meter.
struct Window {
  std::array<double, unknowns> regressors{1.0, 0.0, 0.0, 0.0, 0.0};
  double loss_W = 0.0;
};

Window window_before(const Recording& recording, std::size_t row, const MeteredPower& meter, double transmission) {
  const auto position_m = recording.at(channel::position_m), torque_Nm = recording.at(channel::torque_cmd_Nm);
  const double window_s = static_cast<double>(meter.window) * recording.sample_s;
  Window window;
  double work_J = 0.0;
  for (std::size_t i = meter.first_tick(row); i < meter.first_tick(row) + meter.window; ++i) {
    const double travel_m = position_m[i + 1] - position_m[i];
    const std::size_t direction = travel_m > 0.0 ? 0 : 1;
    work_J += transmission * torque_Nm[i] * travel_m;
    window.regressors[1 + direction] += std::abs(travel_m) / window_s;
    window.regressors[3 + direction] += travel_m * travel_m / recording.sample_s / window_s;
  }
  window.loss_W = recording.at(channel::power_W)[row] - work_J / window_s;
  return window;
}

}  // namespace

std::optional<ElectricalLossFit> fit_electrical_loss(std::span<const Recording> recordings,
                                                     const plant::AxisParameters& axis) {
  std::vector<Window> windows;
  for (const auto& recording : recordings) {
    if (!recording.has(channel::power_W)) continue;
    const auto meter = metered_rows(recording, axis);
    for (const std::size_t row : meter.rows) {
      if (row + 1 < recording.size())
        windows.push_back(window_before(recording, row, meter, 2.0 * std::numbers::pi / axis.axis.lead_m));
    }
  }
  const auto rows = static_cast<Eigen::Index>(windows.size());
  if (rows < 2 * unknowns) return std::nullopt;
  Eigen::MatrixXd regressors(rows, unknowns);
  Eigen::VectorXd loss_W(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Window& window = windows[static_cast<std::size_t>(i)];
    for (int j = 0; j < unknowns; ++j) regressors(i, j) = window.regressors[static_cast<std::size_t>(j)];
    loss_W[i] = window.loss_W;
  }
  const Eigen::VectorXd size = regressors.colwise().norm();
  if (size.minCoeff() <= 0.0) return std::nullopt;  // one direction only
  const auto solver = (regressors * size.cwiseInverse().asDiagonal()).eval().colPivHouseholderQr();
  if (solver.rank() < unknowns) return std::nullopt;
  const Eigen::VectorXd found = solver.solve(loss_W).cwiseQuotient(size);
  const Eigen::VectorXd model_W = regressors * found;
  ElectricalLossFit fit{found[0], {found[1], found[2]}, {found[3], found[4]}, 0.0, {}, {}, {}};
  fit.rms_W = (loss_W - model_W).norm() / std::sqrt(static_cast<double>(rows));
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& r = windows[static_cast<std::size_t>(i)].regressors;
    if (r[1] > 0.02 * r[2] && r[2] > 0.02 * r[1]) continue;
    fit.velocity_m_per_s.push_back(r[1] - r[2]);
    fit.measured_W.push_back(loss_W[i]);
    fit.model_W.push_back(model_W[i]);
  }
  return fit;
}

}  // namespace feedtwin::tools
