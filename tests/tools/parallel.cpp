#include "tools/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace feedtwin::tools {
namespace {

TEST(ParallelFor, DoesEveryPieceOnce) {
  for (const std::size_t count : {0U, 1U, 2U, 7U, 1000U}) {
    std::vector<int> done(count, 0);
    parallel_for(count, [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(std::ranges::count(done, 1), static_cast<std::ptrdiff_t>(count));
  }
}

// All cores have a piece each: more threads would only wait for them. And the next work has all cores again.
TEST(ParallelFor, APieceDoesItsOwnPiecesByItself) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one core";
  constexpr std::size_t outer = 8, inner = 16;
  std::vector<std::vector<std::thread::id>> by(outer, std::vector<std::thread::id>(inner));
  std::vector<std::thread::id> own(outer);
  parallel_for(outer, [&](std::size_t i) {
    own[i] = std::this_thread::get_id();
    parallel_for(inner, [&](std::size_t j) { by[i][j] = std::this_thread::get_id(); });
  });
  for (std::size_t i = 0; i < outer; ++i) EXPECT_EQ(std::ranges::count(by[i], own[i]), std::ptrdiff_t{inner});
  std::vector<std::thread::id> after(2);
  parallel_for(after.size(), [&](std::size_t i) {
    after[i] = std::this_thread::get_id();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  });
  EXPECT_NE(after[0], after[1]);
}

}  // namespace
}  // namespace feedtwin::tools
