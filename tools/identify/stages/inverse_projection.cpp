#include "tools/identify/stages/inverse_projection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/identify/lanes/dispatch.h"

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using lanes::bristle_columns;
using lanes::motion_columns;

enum Regressor : Index { force = 0, rate = 4, acceleration = 8, velocity, one, measured, columns };
constexpr std::array<Index, 5> regressors{acceleration, force, rate, velocity, one};
using Products = Eigen::Matrix<double, columns, columns>;

Products products_at(const Vector3d& x, const InverseMotion& motion, lanes::InverseKernel kernel) {
  lanes::InverseSums sums;
  for (const auto& run : motion.runs) kernel(run, friction_shape(x), sums);
  Products products;
  for (std::size_t i = 0; i < bristle_columns; ++i) {
    for (std::size_t j = 0; j < bristle_columns + motion_columns; ++j) {
      const auto row = static_cast<Index>(i), column = static_cast<Index>(j);
      products(row, column) = products(column, row) = sums.products[i][j];
    }
  }
  products.bottomRightCorner<motion_columns, motion_columns>() = motion.products;
  return products;
}

}  // namespace

lanes::FrictionShape friction_shape(const Vector3d& x) {
  return {std::exp(x[0]), std::max(std::exp(x[1]) - small_rise, 0.0), std::exp(-x[2])};
}

Eigen::Matrix4d motion_products(const lanes::MotionView& run) {
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < run.ticks; ++i) {
    const Eigen::Vector4d row{run.acceleration_m_per_s2[i], run.velocity_m_per_s[i], 1.0, run.force_N[i]};
    products += row * row.transpose();
  }
  return products;
}

InverseProjection::InverseProjection(const InverseMotion& motion) : motion_(motion), kernel_(lanes::best_kernel().inverse) {}

InverseProjection::Point InverseProjection::project(const Vector3d& x) const {
  const Products products = products_at(x, motion_, kernel_);
  Eigen::Matrix<double, 5, 5> normal;
  Eigen::Matrix<double, 5, 1> right;
  for (Index i = 0; i < 5; ++i) {
    for (Index j = 0; j < 5; ++j) normal(i, j) = products(regressors.at(std::size_t(i)), regressors.at(std::size_t(j)));
    right[i] = products(regressors.at(std::size_t(i)), measured);
  }
  const Eigen::Matrix<double, 5, 1> size = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::Matrix<double, 5, 5> scaled = size.asDiagonal() * normal * size.asDiagonal();
  scaled.diagonal().array() += 1e-12;
  const auto solver = scaled.ldlt();
  Point point;
  point.at = x;
  point.linear = size.cwiseProduct(solver.solve(size.cwiseProduct(right)));
  // columns: what the model gains by each of the three, and the residual; then what the five linear numbers take of them
  Eigen::Matrix<double, columns, 4> made = Eigen::Matrix<double, columns, 4>::Zero();
  for (Index k = 0; k < 3; ++k) {
    const double of_shape = k == 1 ? std::exp(x[1]) : 1.0;  // slope of the rise by its logarithm
    made(force + 1 + k, k) = of_shape * point.linear[1];
    made(rate + 1 + k, k) = of_shape * point.linear[2];
  }
  for (Index i = 0; i < 5; ++i) made(regressors.at(std::size_t(i)), 3) = point.linear[i];
  made(measured, 3) = -1.0;
  const Eigen::Matrix<double, columns, 4> made_products = products * made;
  Eigen::Matrix<double, 5, 4> on_regressors;
  for (Index i = 0; i < 5; ++i) on_regressors.row(i) = size[i] * made_products.row(regressors.at(std::size_t(i)));
  on_regressors.col(3).setZero();  // but for rounding
  const Eigen::Matrix4d left = made.transpose() * made_products - on_regressors.transpose() * solver.solve(on_regressors);
  point.cost = left(3, 3);
  point.gradient = left.topRightCorner<3, 1>();
  point.curvature = left.topLeftCorner<3, 3>();
  return point;
}

}  // namespace feedtwin::tools
