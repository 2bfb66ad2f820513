#pragma once
// Dense linear systems of a size known at run time, compiled once: Eigen's decompositions are what a file that has them
// takes longest to compile.

#include <Eigen/Core>
#include <optional>

namespace feedtwin::tools {

/// x of A x = b. @param symmetric A, not negative (LDL^T with pivoting; a direction without curvature gets no part)
[[nodiscard]] Eigen::VectorXd solved(const Eigen::MatrixXd& symmetric, const Eigen::VectorXd& right);
/// A^-1, likewise
[[nodiscard]] Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& symmetric);
/// A^-1, where its reciprocal condition number is not below the least that is asked for.
[[nodiscard]] std::optional<Eigen::MatrixXd> inverse_if_conditioned(const Eigen::MatrixXd& symmetric,
                                                                    double least_reciprocal_condition);
struct PrincipalAxes {
  Eigen::VectorXd values;   ///< eigenvalues, ascending
  Eigen::MatrixXd vectors;  ///< a column each, of length one
};
[[nodiscard]] PrincipalAxes principal_axes(const Eigen::MatrixXd& symmetric);
/// The x that brings A x closest to b; columns that others make up get no part.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);
/// A^T b, on all cores.
[[nodiscard]] Eigen::VectorXd transposed_times(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);
/// A^T A, likewise.
[[nodiscard]] Eigen::MatrixXd gram(const Eigen::MatrixXd& columns);
/// Orthonormal columns that span what the given ones do, as many of them.
[[nodiscard]] Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

}  // namespace feedtwin::tools
