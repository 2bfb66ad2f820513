#include "io/mailbox.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace feedtwin::io {
namespace {

TEST(Mailbox, GivesTheNewestOnce) {
  Mailbox<int> box;
  EXPECT_FALSE(box.take());
  box.draft() = 1;
  box.post();
  box.draft() = 2;
  box.post();
  ASSERT_TRUE(box.take());
  EXPECT_EQ(box.newest(), 2);
  EXPECT_FALSE(box.take());
  EXPECT_EQ(box.newest(), 2) << "stays the reader's own";
}

TEST(Mailbox, NeverTornAndNeverGoesBack) {
  constexpr std::uint64_t last = 200'000;
  Mailbox<std::array<std::uint64_t, 40>> box;
  std::thread writer([&] {
    for (std::uint64_t n = 1; n <= last; ++n) {
      box.draft().fill(n);
      box.post();
    }
  });
  std::uint64_t seen = 0;
  bool torn = false, went_back = false;
  while (seen < last) {
    if (!box.take()) continue;
    const auto& value = box.newest();
    for (const auto word : value) torn = torn || word != value[0];
    went_back = went_back || value[0] <= seen;
    seen = value[0];
  }
  writer.join();
  EXPECT_FALSE(torn);
  EXPECT_FALSE(went_back);
}

}  // namespace
}  // namespace feedtwin::io
