#include "io/command_right.h"

#include <gtest/gtest.h>

namespace feedtwin::io {
namespace {

using Right = CommandRight<int>;
constexpr std::int64_t idle_ns = 100;

TEST(CommandRight, FirstToAskHasItUntilHeLeaves) {
  Right right(idle_ns);
  EXPECT_EQ(right.ask(1, 0), Right::Answer::taken);
  EXPECT_EQ(right.ask(1, 10), Right::Answer::kept);
  EXPECT_EQ(right.ask(2, 20), Right::Answer::refused);
  EXPECT_FALSE(right.release(2));
  EXPECT_TRUE(right.release(1));
  EXPECT_EQ(right.ask(2, 21), Right::Answer::taken);
}

TEST(CommandRight, PassesOnWhenIdleButARefusalKeepsNobodyInOffice) {
  Right right(idle_ns);
  EXPECT_EQ(right.ask(1, 0), Right::Answer::taken);
  EXPECT_EQ(right.ask(2, idle_ns - 1), Right::Answer::refused);
  EXPECT_EQ(right.ask(2, idle_ns), Right::Answer::taken);
  EXPECT_EQ(right.ask(1, idle_ns + 1), Right::Answer::refused) << "the old one has to wait in turn";
}

}  // namespace
}  // namespace feedtwin::io
