#pragma once
// Stage (c): sliding friction from the Stribeck curve of one contact in one direction.
//
//   F = F_C + (F_S - F_C) exp(-|v| / v_S) + mu |v|                     Eq. 3 with the viscous term of Eq. 2
//
// Three of the four are linear, so only v_S is searched for (variable projection: Golub, Pereyra 1973): each trial of v_S
// costs one exponential a point, the rest follows in closed form. One dimension is searched whole: no start is needed and
// no local minimum is taken for the best.

#include <optional>
#include <span>
#include <vector>

namespace feedtwin::tools {

/// Points of a curve; a weight is the number of samples that a point is the mean of.
struct StribeckCurve {
  std::vector<double> speed_m_per_s, force_N, weight;
};

struct StribeckFit {
  double coulomb_N = 0.0, static_N = 0.0, stribeck_m_per_s = 0.0, viscous_Ns_per_m = 0.0;
  double cost = 0.0;  ///< weighted sum of squares

  [[nodiscard]] double force_N(double speed_m_per_s) const noexcept;
};

/// F_C > 0, F_S >= F_C, mu >= 0; v_S between a third of the slowest and a third of the fastest speed. Nothing for fewer than
/// six points.
[[nodiscard]] std::optional<StribeckFit> fit_stribeck_curve(const StribeckCurve& curve);

/// Samples gathered into at most `most_points` points of equal ratio in speed.
[[nodiscard]] StribeckCurve binned_curve(std::span<const double> speed_m_per_s, std::span<const double> force_N,
                                         std::size_t most_points = 200);

}  // namespace feedtwin::tools
