#include "tools/ranks/ranks.h"

#include <gtest/gtest.h>

namespace feedtwin::tools {
namespace {

// Several of them: tests/integration/test_machine.py.
TEST(Ranks, WithoutALauncherThereIsOneAndItHearsItself) {
  const Ranks& ranks = Ranks::world();
  EXPECT_EQ(ranks.size(), 1);
  EXPECT_EQ(ranks.rank(), 0);
  EXPECT_TRUE(ranks.first());
  EXPECT_EQ(ranks.gathered("said"), std::vector<std::string>{"said"});
  EXPECT_EQ(ranks.gathered(""), std::vector<std::string>{""});
  EXPECT_EQ(&Ranks::world(), &ranks);
}

}  // namespace
}  // namespace feedtwin::tools
