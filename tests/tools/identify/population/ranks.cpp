#include "tools/identify/population/ranks.h"

#include <gtest/gtest.h>

namespace feedtwin::tools {
namespace {

TEST(Ranks, AloneComputesEverything) {
  const Ranks ranks;
  EXPECT_EQ(ranks.size(), 1);
  EXPECT_TRUE(ranks.first());
  EXPECT_EQ(ranks.own(19, 8), std::pair(Eigen::Index{0}, Eigen::Index{19}));
  Eigen::MatrixXd columns = Eigen::MatrixXd::Random(3, 5), same = columns;
  ranks.share(same, 8);
  EXPECT_EQ(same, columns);
  EXPECT_EQ(ranks.smallest(7), 7);
  EXPECT_EQ(ranks.first_problem("no"), "no");
}

}  // namespace
}  // namespace feedtwin::tools
