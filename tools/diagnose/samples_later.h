#pragma once
// A reading at moments between its samples.

#include <span>

#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

/// The reading a broken number of samples later, by the cubic through four: a straight line between two would average their
/// noise, and any sensor would look late for the noise that this takes off.
[[nodiscard]] Vector samples_later(std::span<const double> reading, double samples);

}  // namespace feedtwin::tools::diagnosis
