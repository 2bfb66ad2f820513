#pragma once
// A spring that is only met beyond some place, over a sub-step: its force as a discrete gradient,
//
//   F = (U(e1) - U(e0)) / s,   U = k e^2 / 2,   e = depth beyond the place (0 before it), s = path
//
// so that work and stored energy agree even where the sub-step meets or leaves the spring.

#include <cmath>

namespace feedtwin::plant {

struct SpringMean {
  double force_N, slope_N_per_m;  ///< slope by the path
};

/// @param e0_m, e_middle_m, e1_m signed depth at the start, the middle and the end of the path s
[[nodiscard]] inline SpringMean spring_mean(double stiffness_N_per_m, double e0_m, double e_middle_m, double e1_m,
                                            double path_m) noexcept {
  const bool within = e0_m != 0.0 && e1_m != 0.0 && (e0_m > 0.0) == (e1_m > 0.0);
  const bool outside = e0_m == 0.0 && e1_m == 0.0 && e_middle_m == 0.0;
  const bool brief = std::abs(path_m) < 1e-15;
  if (within || outside || brief) return {stiffness_N_per_m * e_middle_m, e_middle_m != 0.0 ? 0.5 * stiffness_N_per_m : 0.0};
  const double force_N = 0.5 * stiffness_N_per_m * (e1_m - e0_m) * (e1_m + e0_m) / path_m;
  return {force_N, (stiffness_N_per_m * e1_m - force_N) / path_m};
}

}  // namespace feedtwin::plant
