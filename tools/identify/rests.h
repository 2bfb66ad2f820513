#pragma once
// Where the encoder shows the same count for many rows, and how much such rows may say.

#include <span>
#include <vector>

namespace feedtwin::tools {

/// Rows [first, end) over which the encoder shows one count.
struct Rest {
  std::size_t first = 0, end = 0;
};

[[nodiscard]] std::vector<Rest> rests_of(std::span<const double> position_m, std::size_t shortest);

/// Where nothing but rounding is left of the command's residual, rows that show the same count are one reading, however
/// many they are.
[[nodiscard]] std::vector<double> reading_weights(std::span<const double> position_m);

/// Rows in which the axis may stick or set off.
[[nodiscard]] std::vector<bool> rows_near_rests(std::span<const double> position_m);

[[nodiscard]] double mean_over(const std::vector<double>& values, const Rest& rest);

}  // namespace feedtwin::tools
