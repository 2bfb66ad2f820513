#pragma once
// Columns of a block of ticks, and the sums of their products. As in kernel_body.h, all is a template on the lane type.

#include <cstddef>

namespace feedtwin::tools::lanes {

/// A block of ticks is worked on together: its columns stay in the nearest cache. It is cut into streams that follow one
/// another, a lane each; tick t stands at streamed(t).
inline constexpr std::size_t streams = 8, stream_ticks = 16, block_ticks = streams * stream_ticks;
template <class Real>
[[nodiscard]] constexpr std::size_t streamed(std::size_t tick) noexcept {
  return tick % stream_ticks * streams + tick / stream_ticks;
}

/// As many streams' ticks as a register has lanes.
template <class Real>
[[nodiscard]] inline Real load_ticks(const double* from) noexcept {
  Real values;
  __builtin_memcpy(&values, from, sizeof values);
  return values;
}

template <class Real>
inline void store_ticks(double* to, const Real& values) noexcept {
  __builtin_memcpy(to, &values, sizeof values);
}

/// Sums over ticks of a column times a column, a lane each; `rows` times `columns` of them stay in registers over a block.
template <class Real, std::size_t rows, std::size_t columns>
struct ProductTile {
  static constexpr std::size_t width = sizeof(Real) / sizeof(double);
  Real sums[rows][columns] = {};

  /// @param first, second that many columns of block_ticks each
  void add(const double* const* first, const double* const* second) noexcept {
    Real tile[rows][columns];
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns; ++c) tile[r][c] = sums[r][c];
    for (std::size_t i = 0; i < block_ticks; i += width) {
      Real left[rows];
      for (std::size_t r = 0; r < rows; ++r) left[r] = load_ticks<Real>(first[r] + i);
      for (std::size_t c = 0; c < columns; ++c) {
        const Real right = load_ticks<Real>(second[c] + i);
        for (std::size_t r = 0; r < rows; ++r) tile[r][c] += left[r] * right;
      }
    }
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns; ++c) sums[r][c] = tile[r][c];
  }

  [[nodiscard]] double total(std::size_t row, std::size_t column) const noexcept {
    double sum = 0.0;
    for (std::size_t lane = 0; lane < width; ++lane) sum += sums[row][column][lane];
    return sum;
  }
};

}  // namespace feedtwin::tools::lanes
