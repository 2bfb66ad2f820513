#pragma once
// The inverse kernel's body; as in kernel_body.h, each instruction set has a lane type of its own.

#include "tools/identify/lanes/block_columns.h"
#include "tools/identify/lanes/bristle_block.h"
#include "tools/identify/lanes/inverse_kernel.h"

namespace feedtwin::tools::lanes {

/// Sums of products of the bristles' columns with each other and with the motion's.
template <class Real>
class InverseProducts {
 public:
  /// @param columns bristle_columns + motion_columns of block_ticks each
  void add(const double* const* columns) noexcept {
    for (std::size_t row = 0; row < row_tiles; ++row)
      for (std::size_t tile = first_tile(row); tile < column_tiles; ++tile)
        tiles_[row][tile].add(columns + row * rows, columns + tile * wide);
  }

  void add_to(InverseSums& all) const noexcept {
    for (std::size_t i = 0; i < bristle_columns; ++i) {
      for (std::size_t j = 0; j < bristle_columns + motion_columns; ++j) {
        const bool there = j / wide >= first_tile(i / rows);
        const std::size_t row = there ? i : j, column = there ? j : i;
        all.products[i][j] += tiles_[row / rows][column / wide].total(row % rows, column % wide);
      }
    }
  }

 private:
  static constexpr std::size_t rows = 4;                          // of a tile
  static constexpr std::size_t wide = sizeof(Real) < 64 ? 2 : 4;  // what 16 registers hold, or 32
  static constexpr std::size_t row_tiles = bristle_columns / rows;
  static constexpr std::size_t column_tiles = (bristle_columns + motion_columns) / wide;
  /// The tiles before it have their products in another's place.
  static constexpr std::size_t first_tile(std::size_t row) noexcept { return row * rows / wide; }
  ProductTile<Real, rows, wide> tiles_[row_tiles][column_tiles];
};

template <class Real>
[[gnu::flatten]] void run_inverse(const MotionView& motion, const FrictionShape& shape, InverseSums& sums) {
  alignas(64) double columns[bristle_columns + motion_columns][block_ticks] = {};
  double (*moved)[block_ticks] = columns + bristle_columns;
  for (double& one : moved[2]) one = 1.0;
  const double* pointers[bristle_columns + motion_columns];
  for (std::size_t c = 0; c < bristle_columns + motion_columns; ++c) pointers[c] = columns[c];
  BristleBlock<Real> bristle(shape, motion.tick_s);
  InverseProducts<Real> products;
  for (std::size_t first = 0; first < motion.ticks; first += block_ticks) {
    const std::size_t count = motion.ticks - first < block_ticks ? motion.ticks - first : block_ticks;
    for (std::size_t t = 0; t < count; ++t) {
      moved[0][streamed<Real>(t)] = motion.acceleration_m_per_s2[first + t];
      moved[1][streamed<Real>(t)] = motion.velocity_m_per_s[first + t];
      moved[3][streamed<Real>(t)] = motion.force_N[first + t];
    }
    for (std::size_t t = count; t < block_ticks; ++t) moved[1][streamed<Real>(t)] = 0.0;
    bristle.follow(moved[1], columns);
    for (std::size_t t = count; t < block_ticks; ++t)  // after the last tick there is nothing
      for (std::size_t c = 0; c < bristle_columns; ++c) columns[c][streamed<Real>(t)] = 0.0;
    products.add(pointers);
  }
  products.add_to(sums);
}

}  // namespace feedtwin::tools::lanes
