#pragma once
// The inverse model's bristle along a recorded motion, its slopes by the friction's shape, and the sums of products that a
// projected least-squares step needs: one pass over the record gives cost, normal equations and derivatives.
//
// Forces are in units of F_C, so that F_C itself is one of the linear numbers:   F / F_C = f(sigma0 / F_C, F_S / F_C, v_S)

#include <array>
#include <cstddef>

namespace feedtwin::tools::lanes {

/// What the force is not linear in.
struct FrictionShape {
  double per_length_per_m;          ///< sigma0 / F_C, 1/m
  double rise;                      ///< F_S / F_C - 1
  double inverse_stribeck_s_per_m;  ///< 1 / v_S
};
inline constexpr std::size_t shape_slopes = 3;  ///< by ln(sigma0 / F_C), F_S / F_C, ln v_S

/// A recorded motion, tick by tick; all arrays are `ticks` long.
struct MotionView {
  std::size_t ticks;
  double tick_s;
  const double *velocity_m_per_s, *acceleration_m_per_s2, *force_N;  ///< mean over each tick
};

/// Columns of the sums: mean bristle force f and its slopes, mean rate dz/dt and its slopes.
inline constexpr std::size_t bristle_columns = 2 * (1 + shape_slopes);
inline constexpr std::size_t motion_columns = 4;  ///< acceleration, velocity, 1, force
struct InverseSums {
  /// [i][j]: sum over the ticks of column i times column j
  std::array<std::array<double, bristle_columns + motion_columns>, bristle_columns> products{};
};

/// Adds a motion's ticks to the sums; the bristle starts unloaded.
using InverseKernel = void (*)(const MotionView& motion, const FrictionShape& shape, InverseSums& sums);

}  // namespace feedtwin::tools::lanes
