#pragma once
// What of a channel's residuals could not be foreseen from their past, and how large it usually is; robust against single
// ticks. Whether an axis sticks at a reversal for a tick more is chance, and makes one residual of a hundred deviations: by
// least squares that one would set the scale and the colour of all others.

#include <vector>

#include "tools/identify/whitening.h"

namespace feedtwin::tools {

/// Student's t, of four degrees of freedom, times `scale`.
struct Innovations {
  std::vector<std::vector<double>> values;  ///< in units of the scale
  double scale = 1.0;                       ///< in the residuals' unit
  Whitening colour;                         ///< of the cleaned residuals

  /// Log density of one of the values, in the residuals' unit, but for a constant.
  [[nodiscard]] double log_density(double value) const;
};

/// Of an autoregressive process, over several stretches of one channel; the past is cleaned of what was not foreseen by far
/// (Martin, Thomson: Robust-Resistant Spectrum Estimation, Proc. IEEE 70, 1982).
[[nodiscard]] Innovations innovations_of(const std::vector<std::vector<double>>& residuals, std::size_t highest_order = 24,
                                         double smallest_sigma = 1e-9);

}  // namespace feedtwin::tools
