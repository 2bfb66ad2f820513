#pragma once
// The inverse model's cost about a friction shape, after the best five linear numbers (variable projection with Kaufman's
// slopes, BIT 15, 1975), from the sums of products that one pass over the record gives (lanes/inverse_kernel.h).

#include <Eigen/Core>
#include <vector>

#include "tools/identify/lanes/kernel.h"

namespace feedtwin::tools {

/// The friction shape of what is searched for:   x = ln(sigma0 / F_C), ln(F_S / F_C - 1 + small_rise), ln v_S   in SI units.
/// The second is a logarithm where there is a rise, and yet there may be none.
inline constexpr double small_rise = 0.02;
[[nodiscard]] lanes::FrictionShape friction_shape(const Eigen::Vector3d& x);

/// Motions, and the sums of products of their own four columns, which no friction changes.
struct InverseMotion {
  std::vector<lanes::MotionView> runs;
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();  ///< of acceleration, velocity, 1, force
};
[[nodiscard]] Eigen::Matrix4d motion_products(const lanes::MotionView& run);

class InverseProjection {
 public:
  struct Point {
    Eigen::Vector3d at;
    Eigen::Matrix<double, 5, 1> linear;  ///< M, F_C, sigma1, mu, F_0
    double cost = 0.0;                   ///< sum of squares r' r, N^2
    Eigen::Vector3d gradient;            ///< J' r: half the cost's slopes
    Eigen::Matrix3d curvature;           ///< J' J
  };

  /// @param motion must outlive it
  explicit InverseProjection(const InverseMotion& motion);

  /// One pass over the record.
  [[nodiscard]] Point project(const Eigen::Vector3d& x) const;

 private:
  const InverseMotion& motion_;
  lanes::InverseKernel kernel_;
};

}  // namespace feedtwin::tools
