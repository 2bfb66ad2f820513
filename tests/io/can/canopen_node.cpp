#include "io/can/canopen_node.h"

#include <gtest/gtest.h>

#include "tests/io/can/bus_master.h"

namespace feedtwin::io::can {
namespace {

TEST(CanopenNode, BootsUpAndFollowsNetworkManagement) {
  BusWithMaster b;
  EXPECT_EQ(b.last(0x701), make_frame(0x701, {0}));
  EXPECT_EQ(b.nodes[0]->nmt_state(), NmtState::pre_operational);
  b.nmt(1, 2);  // another node
  EXPECT_EQ(b.nodes[0]->nmt_state(), NmtState::pre_operational);
  b.nmt(1, 1);
  EXPECT_EQ(b.nodes[0]->nmt_state(), NmtState::operational);
  b.nmt(2);
  EXPECT_EQ(b.nodes[0]->nmt_state(), NmtState::stopped);
  b.nmt(0x80);
  EXPECT_EQ(b.nodes[0]->nmt_state(), NmtState::pre_operational);
  ASSERT_EQ(b.write(0x6072, 0, 1000, 2), 0U);
  ASSERT_EQ(b.write(0x1017, 0, 1000, 2), 0U);
  b.nmt(0x82);
  EXPECT_EQ(b.read(0x1017), 0);     // communication objects are back
  EXPECT_EQ(b.read(0x6072), 1000);  // the application's are not
  b.nmt(0x81);
  EXPECT_EQ(b.last(0x701), make_frame(0x701, {0}));
  EXPECT_EQ(b.read(0x6072), 3000);
}

TEST(CanopenNode, TpdosCarryTheLastTicksState) {
  BusWithMaster b;
  b.enable();
  b.reports[0].encoder_counts = -5'000'000'000LL;  // beyond i32: wraps
  b.reports[0].torque_Nm = -0.635;
  b.reports[0].velocity_m_per_s = 0.01;
  b.tick();
  b.heard.clear();
  for (int i = 0; i < 10; ++i) b.command(1, 0x0F, 0);
  EXPECT_EQ(b.count(0x181), 10);
  EXPECT_EQ(b.count(0x281), 1);
  const auto tpdo = *b.last(0x181);
  ASSERT_EQ(tpdo.length, 8);
  EXPECT_EQ(load<std::uint16_t>(tpdo, 0) & 0x6F, 0x27);
  EXPECT_EQ(load<std::int32_t>(tpdo, 2), static_cast<std::int32_t>(-5'000'000'000LL));
  EXPECT_EQ(load<std::int16_t>(tpdo, 6), -500);
  const auto slow = *b.last(0x281);
  ASSERT_EQ(slow.length, 7);
  EXPECT_EQ(load<std::int32_t>(slow, 0), 131072);
  EXPECT_EQ(slow.data[4], 10);
}

TEST(CanopenNode, PdosPassInOperationalOnly) {
  BusWithMaster b;
  b.command(1, 0x06, 100);
  EXPECT_EQ(b.count(0x181), 0);
  EXPECT_EQ(b.nodes[0]->counters().not_operational, 1U);
  EXPECT_EQ(b.nodes[0]->drive_state(), Cia402State::switch_on_disabled);
}

TEST(CanopenNode, HeartbeatIsSupervisedFromTheFirstOneOn) {
  BusWithMaster b;
  ASSERT_EQ(b.write(0x1016, 1, 0x7F << 16 | 20, 4), 0U);
  ASSERT_EQ(b.write(0x1017, 0, 10, 2), 0U);
  b.enable();
  b.heard.clear();
  for (int i = 0; i < 60; ++i) b.command(1, 0x0F, 100);
  EXPECT_EQ(b.count(0x81), 0);        // none seen yet: not armed
  EXPECT_NEAR(b.count(0x701), 9, 1);  // every 10 ms of 90
  EXPECT_EQ(b.last(0x701)->data[0], 0x05);
  b.say(make_frame(0x77F, {5}));
  for (int i = 0; i < 30; ++i) b.command(1, 0x0F, 100);
  EXPECT_EQ(load<std::uint16_t>(*b.last(0x81), 0), 0x8130);
  EXPECT_EQ(b.nodes[0]->drive_state(), Cia402State::fault);
}

TEST(CanopenNode, LeavingOperationalDropsTheTorque) {
  for (const int command : {0x02, 0x80, 0x81, 0x82}) {
    BusWithMaster b;
    b.enable();
    b.command(1, 0x0F, 300);
    ASSERT_GT(b.requests[0].torque_Nm, 0.0);
    b.nmt(command);
    b.tick();
    EXPECT_EQ(b.requests[0].torque_Nm, 0.0) << command;
    EXPECT_FALSE(b.requests[0].enable) << command;
  }
}

}  // namespace
}  // namespace feedtwin::io::can
