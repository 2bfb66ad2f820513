#include "tools/identify/stages/sliding.h"

#include <cmath>

#include "tools/linear_systems.h"

namespace feedtwin::tools {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
constexpr double least_reciprocal_condition = 1e-10;

}  // namespace

std::optional<SlidingFit> fit_sliding(std::span<const ComponentForces> runs,
                                      std::vector<double> ComponentForces::* component, double slowest_m_per_s,
                                      double settled_m) {
  Matrix5 normal = Matrix5::Zero();
  Vector5 right = Vector5::Zero();
  double squares = 0.0, samples = 0.0;
  for (const auto& run : runs) {
    const auto& force_N = run.*component;
    // the last rows have no acceleration of their own
    for (std::size_t i = 0; i + 2 < force_N.size(); ++i) {
      const double v = run.velocity_m_per_s[i];
      if (std::abs(v) < slowest_m_per_s || run.since_reversal_m[i] < settled_m) continue;
      const bool positive = v > 0.0;
      const Vector5 row{run.acceleration_m_per_s2[i], positive ? 1.0 : 0.0, positive ? 0.0 : -1.0, positive ? v : 0.0,
                        positive ? 0.0 : v};
      normal += row * row.transpose();
      right += row * force_N[i];
      squares += force_N[i] * force_N[i];
      samples += 1.0;
    }
  }
  if (samples < 50.0 || normal.diagonal().minCoeff() <= 0.0) return std::nullopt;
  const Vector5 size = normal.diagonal().cwiseSqrt();
  const Matrix5 scaled = size.cwiseInverse().asDiagonal() * normal * size.cwiseInverse().asDiagonal();
  const auto inverse = inverse_if_conditioned(scaled, least_reciprocal_condition);
  if (!inverse) return std::nullopt;
  const Vector5 found = (*inverse * right.cwiseQuotient(size)).cwiseQuotient(size);
  const double variance = std::max(squares - found.dot(right), 0.0) / samples;
  return SlidingFit{found[0],
                    {found[1], found[2]},
                    {found[3], found[4]},
                    std::sqrt(variance * (*inverse)(0, 0)) / size[0],
                    std::sqrt(variance)};
}

}  // namespace feedtwin::tools
