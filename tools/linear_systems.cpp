#include "tools/linear_systems.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <vector>

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

std::optional<MatrixXd> inverse_if_conditioned(const MatrixXd& symmetric, double least_reciprocal_condition) {
  const auto solver = symmetric.ldlt();
  if (solver.info() != Eigen::Success || solver.rcond() < least_reciprocal_condition) return std::nullopt;
  return solver.solve(MatrixXd::Identity(symmetric.rows(), symmetric.cols()));
}

PrincipalAxes principal_axes(const MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXd least_squares(const MatrixXd& columns, const VectorXd& values) {
  return columns.colPivHouseholderQr().solve(values);
}

VectorXd transposed_times(const MatrixXd& columns, const VectorXd& values) {
  VectorXd products(columns.cols());
  parallel_for(static_cast<std::size_t>(columns.cols()), [&](std::size_t column) {
    const auto i = static_cast<Eigen::Index>(column);
    products[i] = columns.col(i).dot(values);
  });
  return products;
}

MatrixXd gram(const MatrixXd& columns) {
  // rows that stay in a core's cache while they are multiplied; pieces of work whatever the cores: the same sums in the same
  // order
  constexpr Eigen::Index block = 512, pieces = 32;
  const Eigen::Index n = columns.cols(), rows = columns.rows();
  std::vector<MatrixXd> parts(static_cast<std::size_t>(pieces));
  parallel_for(parts.size(), [&](std::size_t piece) {
    MatrixXd& part = parts[piece] = MatrixXd::Zero(n, n);
    for (Eigen::Index first = static_cast<Eigen::Index>(piece) * block; first < rows; first += pieces * block) {
      const auto some = columns.middleRows(first, std::min(block, rows - first));
      part.selfadjointView<Eigen::Lower>().rankUpdate(some.transpose());
    }
  });
  MatrixXd products = MatrixXd::Zero(n, n);
  for (const MatrixXd& part : parts) products += part;
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
  return products;
}

MatrixXd orthonormal(const MatrixXd& columns) {
  const Eigen::HouseholderQR<MatrixXd> qr(columns);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), columns.cols());
}

}  // namespace feedtwin::tools
