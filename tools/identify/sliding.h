#pragma once
// Where friction is that of sliding: beyond the pre-sliding that follows a reversal or a rest.

#include <cstddef>
#include <span>
#include <vector>

namespace feedtwin::tools {

/// Slower than this an axis may stick, as far as its encoder tells.
inline constexpr double standstill_m_per_s = 2e-4;

/// Row by row: has the axis gone far enough one way, and long enough for a smeared velocity to know?
[[nodiscard]] std::vector<bool> rows_of_sliding(std::span<const double> velocity_m_per_s, double sample_s);

/// The same of positions on an encoder's grid; not beside rows that do not slide.
[[nodiscard]] std::vector<bool> rows_of_surely_sliding(std::span<const double> position_m, double sample_s);

/// Rows [first, end) that are set, one stretch after another; those too short to tell a colour by are left out.
struct Stretch {
  std::size_t first = 0, end = 0;
};
[[nodiscard]] std::vector<Stretch> stretches_of(const std::vector<bool>& rows);

}  // namespace feedtwin::tools
