#include "tools/linear_systems.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

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

MatrixXd orthonormal(const MatrixXd& columns) {
  const Eigen::HouseholderQR<MatrixXd> qr(columns);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), columns.cols());
}

}  // namespace feedtwin::tools
