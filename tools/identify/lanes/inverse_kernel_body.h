#pragma once
// The inverse kernel's body; as in kernel_body.h, each instruction set has a lane type of its own.

#include <utility>

#include "plant/lugre.h"
#include "tools/identify/lanes/inverse_kernel.h"

namespace feedtwin::tools::lanes {

/// The four shapes in as many registers as they take; the plant's own friction step on each.
template <class Real>
class ShapedBristles {
 public:
  static constexpr std::size_t width = sizeof(Real) / sizeof(double);
  static constexpr std::size_t registers = shapes_at_once / width;
  static_assert(registers * width == shapes_at_once);

  ShapedBristles(const FrictionShape* shapes, double tick_s) noexcept : tick_s_(tick_s), per_tick_Hz_(1.0 / tick_s) {
    for (std::size_t s = 0; s < shapes_at_once; ++s) {
      auto& lane = lanes_[s / width];
      lane.bristle.stiffness_N_per_m[s % width] = shapes[s].per_length_per_m;
      lane.bristle.compliance_m_per_N[s % width] = 1.0 / shapes[s].per_length_per_m;
      lane.side.coulomb_N[s % width] = 1.0;
      lane.side.stribeck_rise_N[s % width] = shapes[s].rise;
      lane.side.inverse_stribeck_s_per_m[s % width] = shapes[s].inverse_stribeck_s_per_m;
      lane.beside[s % width] = s > 0 ? 1.0 : 0.0;
    }
  }

  /// One tick; `row` takes the first shape's force and what the others have beyond it, then the rates likewise.
  [[gnu::always_inline]] void step(double velocity_m_per_s, double* row) noexcept {
    const double sign = velocity_m_per_s < 0.0 ? -1.0 : 1.0;
    Real force[registers], rate[registers];
    for (std::size_t i = 0; i < registers; ++i) {
      auto& lane = lanes_[i];
      const auto moved = plant::lugre_step<Real>(lane.bristle, lane.side, Real{} + sign, Real{} + sign * velocity_m_per_s,
                                                 lane.z_m, Real{} + tick_s_, Real{} + per_tick_Hz_);
      force[i] = moved.force_N;
      rate[i] = (moved.bristle_m - lane.z_m) * per_tick_Hz_;
      lane.z_m = moved.bristle_m;
    }
    const Real first_force = Real{} + force[0][0], first_rate = Real{} + rate[0][0];
    for (std::size_t i = 0; i < registers; ++i) {
      force[i] -= lanes_[i].beside * first_force;
      rate[i] -= lanes_[i].beside * first_rate;
      __builtin_memcpy(row + i * width, &force[i], sizeof(Real));
      __builtin_memcpy(row + shapes_at_once + i * width, &rate[i], sizeof(Real));
    }
  }

 private:
  struct Lane {
    plant::LugreBristle<Real> bristle;  // without damping: its force is linear and comes from the rate
    plant::LugreSide<Real> side;        // without viscous friction, likewise
    Real beside{};                      // 0 for the first shape, 1 for the others
    Real z_m{};
  };
  Lane lanes_[registers];
  double tick_s_, per_tick_Hz_;
};

/// Products of a few rows' columns, a register of columns at a time against every column.
template <class Real>
class ColumnSums {
 public:
  static constexpr std::size_t width = sizeof(Real) / sizeof(double);

  /// @param rows of bristle_columns + motion_columns each
  void add(const double* rows, std::size_t count) noexcept {
    add_registers(rows, count, std::make_index_sequence<bristle_columns / width>{});
  }

  void add_to(InverseSums& all) const noexcept {
    for (std::size_t i = 0; i < bristle_columns; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        all.products[i][j] += j >= i / width * width ? sums_[i / width][j][i % width] : sums_[j / width][i][j % width];
  }

  static constexpr std::size_t columns = bristle_columns + motion_columns;

 private:
  template <std::size_t... r>
  void add_registers(const double* rows, std::size_t count, std::index_sequence<r...> /*registers*/) noexcept {
    (add_register<r>(rows, count), ...);
  }

  /// A register's columns against themselves and those after them: the others are there already.
  template <std::size_t r>
  void add_register(const double* rows, std::size_t count) noexcept {
    Real sums[columns];  // in registers
    for (std::size_t j = r * width; j < columns; ++j) sums[j] = sums_[r][j];
    for (std::size_t i = 0; i < count; ++i) {
      const double* row = rows + i * columns;
      Real some;
      __builtin_memcpy(&some, row + r * width, sizeof some);
      for (std::size_t j = r * width; j < columns; ++j) sums[j] += some * row[j];
    }
    for (std::size_t j = r * width; j < columns; ++j) sums_[r][j] = sums[j];
  }

  Real sums_[bristle_columns / width][columns] = {};
};

template <class Real>
void run_inverse(const MotionView& motion, const FrictionShape* shapes, InverseSums& sums) {
  constexpr std::size_t block = 64;  // stays in the nearest cache
  constexpr std::size_t columns = ColumnSums<Real>::columns;
  alignas(64) double rows[block * columns];
  ShapedBristles<Real> bristles(shapes, motion.tick_s);
  ColumnSums<Real> products;
  for (std::size_t first = 0; first < motion.ticks; first += block) {
    const std::size_t count = motion.ticks - first < block ? motion.ticks - first : block;
    for (std::size_t i = 0; i < count; ++i) {
      double* row = rows + i * columns;
      bristles.step(motion.velocity_m_per_s[first + i], row);
      row[bristle_columns] = motion.acceleration_m_per_s2[first + i];
      row[bristle_columns + 1] = motion.velocity_m_per_s[first + i];
      row[bristle_columns + 2] = 1.0;
      row[bristle_columns + 3] = motion.force_N[first + i];
    }
    products.add(rows, count);
  }
  products.add_to(sums);
}

}  // namespace feedtwin::tools::lanes
