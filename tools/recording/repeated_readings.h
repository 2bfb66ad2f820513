#pragma once
// A power meter that is read more often than its window ends shows each window again, with the reading's own noise.

#include <span>

#include "tools/recording/recording.h"

namespace feedtwin::tools {

/// Readings that show one window: 1, or as many as repeat one another but for noise in all recordings together.
[[nodiscard]] std::size_t readings_of_one_window(std::span<const Recording> recordings);

/// Holds the mean of so many readings in their place, from where in the run they repeat one another best.
void join_readings(Recording& recording, std::size_t readings);

}  // namespace feedtwin::tools
