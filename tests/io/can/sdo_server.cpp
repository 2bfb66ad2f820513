#include "io/can/sdo_server.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/io/can/bus_master.h"

namespace feedtwin::io::can {
namespace {

TEST(SdoServer, ReadsAndWritesExpedited) {
  BusWithMaster b;
  EXPECT_EQ(b.read(0x1000), 0x00020192);
  EXPECT_EQ(b.read(0x6076), 1270);
  EXPECT_EQ(b.read(0x608F, 1), 65536);
  EXPECT_EQ(b.read(0x2003), 5'000'000);
  EXPECT_EQ(b.read(0x6502), 0x200);
  EXPECT_EQ(b.write(0x6071, 0, -123, 2), 0U);
  EXPECT_EQ(b.read(0x6071), 0x10000 - 123);
  EXPECT_EQ(b.nodes[0]->sdo_counters().transfers, 7U);
}

TEST(SdoServer, SaysWhyItRefuses) {
  BusWithMaster b;
  EXPECT_EQ(b.write(0x1000, 0, 1, 4), 0x06010002U);                                              // read only
  EXPECT_EQ(b.write(0x5FFF, 0, 1, 4), 0x06020000U);                                              // no such object
  EXPECT_EQ(b.write(0x1018, 9, 1, 4), 0x06090011U);                                              // no such sub-index
  EXPECT_EQ(b.write(0x6071, 0, 1, 4), 0x06070012U);                                              // too long
  EXPECT_EQ(b.write(0x1006, 0, 1, 2), 0x06070013U);                                              // too short
  EXPECT_EQ(b.write(0x6072, 0, 40000, 2), 0x06090031U);                                          // too high
  EXPECT_EQ(b.write(0x6060, 0, 8, 1), 0x06090030U);                                              // a mode that there is not
  EXPECT_EQ(b.write(0x6060, 0, -1, 1), 0x06090032U);                                             // too low
  EXPECT_EQ(load<std::uint32_t>(*b.ask(1, {0xA0, 0x08, 0x10, 0, 0, 0, 0, 0}), 4), 0x05040001U);  // block upload
  EXPECT_EQ(load<std::uint32_t>(*b.ask(1, {0x60, 0, 0, 0, 0, 0, 0, 0}), 4), 0x05040001U);        // segment of nothing
  EXPECT_EQ(b.nodes[0]->sdo_counters().aborted, 10U);
}

TEST(SdoServer, TextsGoInSegmentsBothWays) {
  BusWithMaster b;
  EXPECT_EQ(b.read_text(0x1008), "feedtwin drive");
  for (const std::string text : {"a longer label", "seven b", "exactly fourteen"}) {
    const int length = static_cast<int>(text.size());
    ASSERT_EQ(b.ask(1, {0x21, 0x00, 0x20, 0, length, 0, 0, 0})->data[0], 0x60);
    int toggle = 0;
    for (std::size_t at = 0; at < text.size(); at += 7, toggle ^= 0x10) {
      const std::size_t n = std::min<std::size_t>(7, text.size() - at);
      Frame segment = make_frame(0x601, {0, 0, 0, 0, 0, 0, 0, 0});
      segment.data[0] = static_cast<std::uint8_t>(toggle | static_cast<int>(7 - n) << 1 | (at + n == text.size() ? 1 : 0));
      for (std::size_t i = 0; i < n; ++i) segment.data[1 + i] = static_cast<std::uint8_t>(text[at + i]);
      b.heard.clear();
      b.say(segment);
      b.tick();
      ASSERT_EQ(b.last(0x581)->data[0], 0x20 | toggle);
    }
    EXPECT_EQ(b.read_text(0x2000), text);
  }
}

TEST(SdoServer, NumbersMayComeInASegmentToo) {
  BusWithMaster b;
  ASSERT_EQ(b.ask(1, {0x21, 0x17, 0x10, 0, 2, 0, 0, 0})->data[0], 0x60);
  ASSERT_EQ(b.ask(1, {0x0B, 0xF4, 0x01, 0, 0, 0, 0, 0})->data[0], 0x20);
  EXPECT_EQ(b.read(0x1017), 500);
}

TEST(SdoServer, WrongToggleWrongLengthAndSilenceEndATransfer) {
  BusWithMaster b;
  ASSERT_EQ(b.ask(1, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0})->data[0], 0x41);
  EXPECT_EQ(load<std::uint32_t>(*b.ask(1, {0x70, 0, 0, 0, 0, 0, 0, 0}), 4), 0x05030000U);
  ASSERT_EQ(b.ask(1, {0x21, 0x17, 0x10, 0, 2, 0, 0, 0})->data[0], 0x60);
  EXPECT_EQ(load<std::uint32_t>(*b.ask(1, {0x09, 1, 2, 3, 0, 0, 0, 0}), 4), 0x06070010U);  // 3 bytes, 2 announced
  ASSERT_EQ(b.ask(1, {0x21, 0x17, 0x10, 0, 3, 0, 0, 0})->data[0], 0x80);                   // longer than the object
  ASSERT_EQ(b.ask(1, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0})->data[0], 0x41);
  for (int i = 0; i < 1000; ++i) b.tick();
  EXPECT_EQ(load<std::uint32_t>(*b.ask(1, {0x60, 0, 0, 0, 0, 0, 0, 0}), 4), 0x05040001U);
  EXPECT_EQ(b.nodes[0]->sdo_counters().given_up, 1U);
  EXPECT_EQ(b.read(0x1017), 0);
}

TEST(SdoServer, IsSilentWhenStopped) {
  BusWithMaster b;
  b.nmt(2);
  EXPECT_FALSE(b.ask(1, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0}));
}

/// Whatever is sent: an answer has 8 bytes and names the object, or an abort; nothing read-only changes.
TEST(SdoServer, SurvivesRandomRequests) {
  BusWithMaster b;
  std::mt19937 random(4);
  FrameQueue out;
  CanopenNode node(DriveIdentity{});
  for (int i = 0; i < 200000; ++i) {
    Frame frame = make_frame(0x601, {0, 0, 0, 0, 0, 0, 0, 0});
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(random());
    const auto& known = object_table()[random() % object_table().size()];
    if (random() % 2 == 0) {
      store(frame, 1, known.index);
      frame.data[3] = known.sub;
    }
    frame.length = static_cast<std::uint8_t>(random() % 20 == 0 ? random() % 8 : 8);
    node.accept(frame, i * 1000, out);
    for (; !out.empty(); out.pop()) {
      if (out.front().id != 0x581) continue;
      ASSERT_EQ(out.front().length, 8);
    }
  }
  for (int i = 0; i < static_cast<int>(object_table().size()); ++i) {
    const auto& entry = object_table()[static_cast<std::size_t>(i)];
    if (entry.type == DataType::text) continue;
    EXPECT_GE(node.objects().get(i), entry.lowest) << entry.name;
    if (entry.index != 0x1003) {
      EXPECT_LE(node.objects().get(i), entry.highest) << entry.name;
    }
    if (entry.access == Access::constant) {
      EXPECT_EQ(node.objects().get(i), preset_of(entry, DriveIdentity{})) << entry.name;
    }
  }
  EXPECT_GT(node.sdo_counters().transfers, 1000U);
}

}  // namespace
}  // namespace feedtwin::io::can
