#pragma once
// A force whose frequency runs up or down with time: a machine beside that starts, a rotor that runs out. It repeats over
// nothing and is no line of a run, but within some seconds it is one wave, and the next seconds go on where they ended.

#include <optional>

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

struct Sweep {
  double low_Hz = 0.0, high_Hz = 0.0;
  double rate_Hz_per_s = 0.0;  ///< mean; negative: it runs out
  double amplitude_N = 0.0;
};

/// The sweep that the equation of the table holds (its own behind a force sensor, otherwise the sum), wherever the axis has
/// settled.
/// @param residual N, rows of all equations
/// @return none where fewer than four stretches of two seconds go on from the one before, at a frequency that moves; six
/// where it moves slower than 1 Hz a second, all one way
[[nodiscard]] std::optional<Sweep> sweep_of(const InverseModel& model, const Vector& residual);

}  // namespace feedtwin::tools::diagnosis
