#include "tools/linear_systems.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>

#include "tools/parallel.h"

namespace feedtwin::tools {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solved(const MatrixXd& symmetric, const VectorXd& right) {
  return symmetric.ldlt().solve(right);
}

MatrixXd inverse_of(const MatrixXd& symmetric) {
  return symmetric.ldlt().solve(MatrixXd::Identity(symmetric.rows(), symmetric.cols()));
}

VectorXd least_squares(const MatrixXd& columns, const VectorXd& values) {
  return columns.colPivHouseholderQr().solve(values);
}

MatrixXd gram(const MatrixXd& columns) {
  constexpr Eigen::Index width = 8;  // of a piece of work, whatever the cores: the same sums in the same order
  const Eigen::Index n = columns.cols();
  MatrixXd products(n, n);
  parallel_for(static_cast<std::size_t>((n + width - 1) / width), [&](std::size_t piece) {
    const Eigen::Index first = static_cast<Eigen::Index>(piece) * width, own = std::min(width, n - first);
    products.block(first, first, n - first, own).noalias() =
        columns.rightCols(n - first).transpose() * columns.middleCols(first, own);
  });
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
  return products;
}

MatrixXd orthonormal(const MatrixXd& columns) {
  const Eigen::HouseholderQR<MatrixXd> qr(columns);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), columns.cols());
}

}  // namespace feedtwin::tools
