#include "tests/challenge/strength.h"

#include <Eigen/Dense>
#include <cmath>

namespace feedtwin::challenge {
namespace {

constexpr int regressors = 7;

std::array<double, regressors> row_of(const Sample& s) {
  const double v = s.true_velocity_m_per_s;
  const double forth = v > 0.0 ? 1.0 : 0.0;
  const double back = v < 0.0 ? 1.0 : 0.0;
  const double slow = std::exp(-std::abs(v) / 1.5e-3);
  return {s.true_acceleration_m_per_s2, forth * v, back * v, forth, -back, forth * slow, -back * slow};
}

}  // namespace

Leftover leftover(const std::vector<Run>& runs, double lead_m) {
  constexpr int half = 7, settled = 40;
  const double k = 6.283185307179586 / lead_m;
  std::vector<double> rows;
  std::vector<double> force_N;
  for (const Run& run : runs) {
    int sliding_for = 0;  // samples since the last reversal or stop
    for (std::size_t i = half; i + half < run.size(); ++i) {
      const double v = run[i].true_velocity_m_per_s;
      const bool slides =
          std::abs(v) > 2e-4 && v * run[i - 1].true_velocity_m_per_s > 0.0 && run[i + half].true_velocity_m_per_s * v > 0.0;
      sliding_for = slides ? sliding_for + 1 : 0;
      if (sliding_for < settled || i % half != 0) continue;
      std::array<double, regressors> mean{};
      double force = 0.0;
      for (std::size_t j = i - half; j <= i + half; ++j) {
        const auto row = row_of(run[j]);
        for (std::size_t c = 0; c < regressors; ++c) mean[c] += row[c] / (2 * half + 1);
        force += k * run[j].torque_cmd_Nm / (2 * half + 1);
      }
      rows.insert(rows.end(), mean.begin(), mean.end());
      force_N.push_back(force);
    }
  }
  const auto n = static_cast<Eigen::Index>(force_N.size());
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, regressors, Eigen::RowMajor>> A(rows.data(), n, regressors);
  const Eigen::Map<const Eigen::VectorXd> b(force_N.data(), n);
  const Eigen::VectorXd x = A.colPivHouseholderQr().solve(b);
  Leftover result;
  result.rms_N = (b - A * x).norm() / std::sqrt(static_cast<double>(n));
  result.numbers.assign(x.data(), x.data() + regressors);
  return result;
}

}  // namespace feedtwin::challenge
