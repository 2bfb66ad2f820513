#include "tools/identify/population/shared_columns.h"

#include <gtest/gtest.h>

namespace feedtwin::tools {
namespace {

TEST(SharedColumns, AloneComputesEverything) {
  const Ranks& ranks = Ranks::world();
  ASSERT_EQ(ranks.size(), 1);
  EXPECT_EQ(own_columns(ranks, 19, 8), std::pair(Eigen::Index{0}, Eigen::Index{19}));
  const Eigen::MatrixXd columns = Eigen::MatrixXd::Random(3, 5);
  Eigen::MatrixXd same = columns;
  share_columns(ranks, same, 8);
  EXPECT_EQ(same, columns);
  EXPECT_EQ(smallest_of(ranks, 7), 7U);
  EXPECT_EQ(first_problem(ranks, "no"), "no");
  EXPECT_EQ(first_problem(ranks, ""), "");
}

}  // namespace
}  // namespace feedtwin::tools
