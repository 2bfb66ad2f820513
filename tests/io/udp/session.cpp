#include "io/udp/session.h"

#include <gtest/gtest.h>

namespace feedtwin::io::udp {
namespace {

using Verdict = Session::Verdict;
constexpr Peer one{1, 1}, other{1, 2};

TEST(UdpSession, DuplicatesAndOvertakenOnesAreNotUsed) {
  Session session(1000);
  EXPECT_EQ(session.judge(one, 10, 0), Verdict::use);
  EXPECT_EQ(session.judge(one, 12, 1), Verdict::use);
  EXPECT_EQ(session.lost(), 1U);
  EXPECT_EQ(session.judge(one, 12, 2), Verdict::duplicate);
  EXPECT_EQ(session.judge(one, 11, 3), Verdict::late);
  EXPECT_EQ(session.wire_sequence(), 12U);
  EXPECT_EQ(session.judge(one, 13, 4), Verdict::use);
}

TEST(UdpSession, TheSequenceMayWrap) {
  Session session(1000);
  EXPECT_EQ(session.judge(one, 0xFFFF'FFFF, 0), Verdict::use);
  const auto before = session.sequence();
  EXPECT_EQ(session.judge(one, 0, 1), Verdict::use);
  EXPECT_EQ(session.sequence(), before + 1);
  EXPECT_EQ(session.lost(), 0U);
}

TEST(UdpSession, AnotherPeerIsRefusedUntilTheCommanderHasBeenSilent) {
  Session session(1000);
  EXPECT_EQ(session.judge(one, 500, 0), Verdict::use);
  EXPECT_EQ(session.judge(other, 1, 999), Verdict::refused);
  const auto before = session.sequence();
  EXPECT_EQ(session.judge(other, 1, 1000), Verdict::use);
  EXPECT_GT(session.sequence() - before, 1000U) << "must look like a fresh start, not like an old request";
  EXPECT_LT(session.sequence() - before, 0x8000'0000U);
  EXPECT_EQ(session.judge(one, 501, 1001), Verdict::refused);
}

TEST(UdpSession, AControllerThatStartsAgainAfterAPauseCountsFromAnywhere) {
  Session session(1000);
  EXPECT_EQ(session.judge(one, 500, 0), Verdict::use);
  EXPECT_EQ(session.judge(one, 1, 500), Verdict::late);
  EXPECT_EQ(session.judge(one, 1, 1500), Verdict::use);
  EXPECT_EQ(session.judge(one, 2, 1501), Verdict::use);
  EXPECT_EQ(session.sessions(), 2U);
}

}  // namespace
}  // namespace feedtwin::io::udp
