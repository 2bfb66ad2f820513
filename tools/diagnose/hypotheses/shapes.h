#pragma once
// Shapes that several hypotheses share.

#include <numbers>
#include <vector>

#include "tools/diagnose/hypothesis.h"

namespace feedtwin::tools::diagnosis {

/// 2 pi / lead.
[[nodiscard]] inline double per_lead(const plant::AxisParameters& axis) {
  return 2.0 * std::numbers::pi / axis.axis.lead_m;
}

/// sine sin(2 pi n x / period) + cosine cos(...)
[[nodiscard]] Vector wave(const Vector& x, double period, double order, double sine, double cosine);
/// Later by a number of samples, which need not be whole; linear between samples. Negative: earlier.
[[nodiscard]] Vector delayed(const Vector& values, double samples);
/// First-order lag of a number of samples.
[[nodiscard]] Vector lagged(const Vector& values, double samples);

/// Grids of shape parameters.
using Grid = std::vector<std::vector<double>>;
[[nodiscard]] Grid whole_orders(int first, int last);
[[nodiscard]] Grid ripple_orders();  ///< one and two a revolution, and everything between that is not whole
[[nodiscard]] Grid frequencies();    ///< 8 to 45 Hz
[[nodiscard]] Grid torque_limits();
[[nodiscard]] Grid spots();  ///< places along a stroke and widths

}  // namespace feedtwin::tools::diagnosis
