#pragma once
// Lines in a residual's spectrum: one frequency that keeps its phase over a whole run is no noise, and must not be whitened
// away.

#include <optional>

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

/// The sum of the sharp lines of each run in each force equation, where the axis has settled; zero elsewhere. A line stands
/// far above the spectrum beside it and is no wider than the run allows.
[[nodiscard]] Vector sharp_lines(const InverseModel& model, const Vector& residual);

/// Frequency of the strongest such line of one segment above a frequency.
[[nodiscard]] std::optional<double> strongest_line_Hz(const InverseModel& model, const Vector& residual,
                                                      const Segment& segment, double above_Hz);

}  // namespace feedtwin::tools::diagnosis
