#pragma once
// Residuals of a simulation are coloured: a closed loop and a missing force both leave them correlated over many samples.
// An autoregressive filter makes them white, so that least squares weighs them rightly and its intervals are honest.

#include <span>
#include <vector>

namespace feedtwin::tools {

/// e_k = (r_k - sum a_i r_k-i) / sigma
struct Whitening {
  std::vector<double> coefficients;  ///< a_1 .. a_p
  double sigma = 1.0;                ///< of what the coefficients leave

  /// In place; the first samples, which have no full past, use what there is.
  void apply(std::span<double> residuals) const;
};

/// Yule-Walker over several stretches of the same channel (Levinson's recursion), of an order that the length can bear, at
/// most `highest_order`. @param smallest_sigma floor for a channel without any residual
[[nodiscard]] Whitening fit_whitening(std::span<const std::vector<double>> stretches, std::size_t highest_order,
                                      double smallest_sigma);

/// Standard deviation of a channel's white part, from third differences, robust against everything that is smooth.
[[nodiscard]] double white_sigma(std::span<const double> x);

}  // namespace feedtwin::tools
