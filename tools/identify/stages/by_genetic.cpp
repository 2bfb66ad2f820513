#include "tools/identify/stages/by_genetic.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::tools {

std::optional<StribeckFit> fit_stribeck_curve_by_genetic(const StribeckCurve& curve, const GeneticSettings& settings) {
  if (curve.speed_m_per_s.size() < 6) return std::nullopt;
  const auto [slowest, fastest] = std::ranges::minmax(curve.speed_m_per_s);
  const double largest_N = std::ranges::max(curve.force_N);
  if (!(slowest > 0.0) || !(largest_N > 0.0)) return std::nullopt;
  const auto fit_at = [](const auto& x) { return StribeckFit{x[0], x[0] + x[1], x[2], x[3], 0.0}; };
  const auto cost = [&](const Eigen::MatrixXd& points) {
    Eigen::VectorXd costs = Eigen::VectorXd::Zero(points.cols());
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
      const StribeckFit fit = fit_at(points.col(p));
      for (std::size_t i = 0; i < curve.force_N.size(); ++i) {
        const double off_N = fit.force_N(curve.speed_m_per_s[i]) - curve.force_N[i];
        costs[p] += curve.weight[i] * off_N * off_N;
      }
    }
    return costs;
  };
  const Eigen::Vector4d lowest{1e-3 * largest_N, 0.0, slowest / 3.0, 0.0};
  const Eigen::Vector4d highest{largest_N, largest_N, fastest / 3.0, 2.0 * largest_N / fastest};
  const auto found = evolve(lowest, highest, cost, settings);
  StribeckFit fit = fit_at(found.point);
  fit.cost = found.cost;
  return fit;
}

std::optional<HysteresisFit> fit_hysteresis_by_genetic(std::span<const ComponentForces> runs,
                                                       std::vector<double> ComponentForces::* component, double mass_kg,
                                                       const plant::LugreParameters& friction,
                                                       const GeneticSettings& settings) {
  const HysteresisCost squares(runs, component, mass_kg, friction);
  if (squares.samples() < 20) return std::nullopt;
  const auto cost = [&squares](const Eigen::MatrixXd& points) {
    Eigen::VectorXd costs(points.cols());
    for (Eigen::Index p = 0; p < points.cols(); ++p) costs[p] = squares.rms_N(points(0, p), points(1, p));
    return costs;
  };
  const double damping = friction.damping_Ns_per_m > 0.0 ? friction.damping_Ns_per_m : 1e-4 * friction.stiffness_N_per_m;
  const Eigen::Vector2d middle{friction.stiffness_N_per_m, damping};
  const auto found = evolve(middle / 30.0, middle * 30.0, cost, settings);
  return HysteresisFit{found.point[0], found.point[1], found.cost, squares.samples()};
}

}  // namespace feedtwin::tools
