#include "tools/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <semaphore>
#include <stdexcept>
#include <thread>
#include <vector>

namespace feedtwin::tools {
namespace {

/// Each waits for the other to begin; by one thread, one after the other, neither would ever see it.
bool two_pieces_go_side_by_side() {
  std::array<std::binary_semaphore, 2> begun{std::binary_semaphore{0}, std::binary_semaphore{0}};
  std::atomic<int> met{0};
  parallel_for(2, [&](std::size_t i) {
    begun[i].release();
    met += begun[1 - i].try_acquire_for(std::chrono::seconds(20));
  });
  return met == 2;
}

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
  EXPECT_TRUE(two_pieces_go_side_by_side());
}

TEST(ParallelFor, WorkThatThrowsLeavesAllCoresToTheNext) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one core";
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> thrown = false;
  EXPECT_THROW(parallel_for(10000,
                            [&](std::size_t) {
                              if (std::this_thread::get_id() != caller)
                                return thrown.wait(false);  // the caller has its turn
                              thrown = true;
                              thrown.notify_all();
                              throw std::runtime_error("a piece");
                            }),
               std::runtime_error);
  EXPECT_TRUE(two_pieces_go_side_by_side());
}

}  // namespace
}  // namespace feedtwin::tools
