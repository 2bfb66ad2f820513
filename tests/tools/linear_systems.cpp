#include "tools/linear_systems.h"

#include <gtest/gtest.h>

#include <random>

#include "tools/large_blocks.h"

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(Index rows, Index columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

TEST(LinearSystems, HoldOverRandomOnes) {
  std::mt19937 random(4);
  for (Index n = 1; n < 30; ++n) {
    const MatrixXd tall = random_matrix(3 * n, n, random), symmetric = tall.transpose() * tall;
    const VectorXd right = random_matrix(n, 1, random), values = random_matrix(3 * n, 1, random);
    EXPECT_LT((symmetric * solved(symmetric, right) - right).norm(), 1e-10 * right.norm());
    EXPECT_LT((symmetric * inverse_of(symmetric) - MatrixXd::Identity(n, n)).norm(), 1e-10);
    const VectorXd left = values - tall * least_squares(tall, values);
    EXPECT_LT((tall.transpose() * left).norm(), 1e-10 * values.norm()) << "what is left over is beside all columns";
    EXPECT_GT(left.norm(), 0.1 * values.norm());
    EXPECT_LT((gram(tall) - symmetric).norm(), 1e-14 * symmetric.norm());
    const MatrixXd q = orthonormal(tall);
    EXPECT_LT((q.transpose() * q - MatrixXd::Identity(n, n)).norm(), 1e-12);
    EXPECT_LT((tall - q * (q.transpose() * tall)).norm(), 1e-12 * tall.norm());
  }
}

TEST(LinearSystems, ProductsOfMoreRowsThanACacheHoldsAreTheSame) {
  std::mt19937 random(6);
  for (const Index rows : {511, 512, 513, 16384, 16385, 40001}) {
    MatrixXd tall = random_matrix(rows, 7, random);
    const VectorXd values = random_matrix(rows, 1, random);
    const MatrixXd products = tall.transpose() * tall;
    const VectorXd with_values = tall.transpose() * values;
    ask_for_large_pages(tall);
    EXPECT_LT((gram(tall) - products).norm(), 1e-13 * products.norm()) << rows;
    EXPECT_LT((transposed_times(tall, values) - with_values).norm(), 1e-13 * tall.norm() * values.norm()) << rows;
  }
}

TEST(LinearSystems, AColumnTwiceIsNoTrouble) {
  std::mt19937 random(5);
  MatrixXd columns = random_matrix(40, 4, random);
  columns.col(3) = columns.col(1);
  const VectorXd values = columns * VectorXd::Ones(4), x = least_squares(columns, values);
  EXPECT_TRUE(x.allFinite());
  EXPECT_LT((columns * x - values).norm(), 1e-10 * values.norm());
}

}  // namespace
}  // namespace feedtwin::tools
