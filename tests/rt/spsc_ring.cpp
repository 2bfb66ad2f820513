#include "rt/spsc_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace feedtwin::rt {
namespace {

TEST(SpscRing, RefusesWholeGroupsThatDoNotFitAndKeepsWhatItHas) {
  SpscRing<int> ring(5);
  ASSERT_EQ(ring.capacity(), 8U);
  const std::array<int, 3> three{1, 2, 3};
  EXPECT_TRUE(ring.push(three));
  EXPECT_TRUE(ring.push(three));
  EXPECT_FALSE(ring.push(three)) << "two places are left for three items";
  EXPECT_TRUE(ring.push(7));
  EXPECT_TRUE(ring.push(8));
  EXPECT_FALSE(ring.push(9));
  std::array<int, 10> out{};
  ASSERT_EQ(ring.pop(out), 8U);
  EXPECT_EQ((std::array<int, 8>{1, 2, 3, 1, 2, 3, 7, 8}),
            (std::array<int, 8>{out[0], out[1], out[2], out[3], out[4], out[5], out[6], out[7]}));
  EXPECT_EQ(ring.pop(out), 0U);
}

TEST(SpscRing, PassesEverythingInOrderBetweenTwoThreads) {
  constexpr std::uint64_t count = 1'000'000;
  SpscRing<std::uint64_t> ring(256);
  std::uint64_t refused = 0;
  std::thread producer([&] {
    for (std::uint64_t i = 0; i < count;) {
      if (ring.push(i)) {
        ++i;
      } else {
        ++refused;
        std::this_thread::yield();
      }
    }
  });
  std::array<std::uint64_t, 64> batch{};
  std::uint64_t expected = 0;
  bool in_order = true;
  while (expected < count) {
    const std::size_t got = ring.pop(batch);
    for (std::size_t i = 0; i < got; ++i) in_order = in_order && batch[i] == expected++;
    if (got == 0) std::this_thread::yield();
  }
  producer.join();
  EXPECT_TRUE(in_order);
  EXPECT_GT(refused, 0U) << "the ring was never full: the test did not test it";
}

}  // namespace
}  // namespace feedtwin::rt
