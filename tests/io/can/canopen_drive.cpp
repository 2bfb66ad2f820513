#include "io/can/canopen_node.h"

#include <gtest/gtest.h>

#include "tests/io/can/bus_master.h"

namespace feedtwin::io::can {
namespace {

TEST(CanopenDrive, TorqueIsLatchedAtSync) {
  BusWithMaster b;
  b.enable();
  b.say(make_frame(0x201, {0x0F, 0, 0xF4, 0x01, 10}));  // 500 per mille
  b.tick();
  EXPECT_EQ(b.fresh, 0U);
  EXPECT_EQ(b.requests[0].torque_Nm, 0.0);
  b.sync();
  EXPECT_EQ(b.fresh, 1U);
  EXPECT_DOUBLE_EQ(b.requests[0].torque_Nm, 0.5 * 1.27);
  EXPECT_TRUE(b.requests[0].enable);
  EXPECT_LT(b.requests[0].arrival_ns, b.bus.now_ns());
  // the newest wins, and the older one is counted
  b.say(make_frame(0x201, {0x0F, 0, 0x0A, 0x00, 10}));
  b.command(1, 0x0F, -20);
  EXPECT_DOUBLE_EQ(b.requests[0].torque_Nm, -0.02 * 1.27);
  EXPECT_EQ(b.nodes[0]->counters().superseded, 1U);
}

TEST(CanopenDrive, MissingCommandsTakeTheTorqueAwayAndSayWhy) {
  BusWithMaster b;
  b.enable();
  b.command(1, 0x0F, 300);
  EXPECT_GT(b.requests[0].torque_Nm, 0.0);
  b.heard.clear();
  for (int i = 0; i < 3; ++i) b.sync();
  EXPECT_TRUE(b.nodes[0]->drive_state() == Cia402State::operation_enabled);
  EXPECT_EQ(b.count(0x81), 0);
  b.sync();
  EXPECT_EQ(b.nodes[0]->drive_state(), Cia402State::fault);
  EXPECT_EQ(b.requests[0].torque_Nm, 0.0);
  EXPECT_FALSE(b.requests[0].enable);
  EXPECT_EQ(*b.last(0x81), make_frame(0x81, {0x50, 0x82, 0x11, 0, 0, 0, 0, 0}));
  EXPECT_EQ(b.read(0x1003, 1), 0x8250);
  EXPECT_EQ(b.read(0x603F), 0x8250);
  // a command alone brings nothing back; a reset and a new start do
  b.command(1, 0x0F, 300);
  EXPECT_EQ(b.requests[0].torque_Nm, 0.0);
  b.command(1, 0x80, 0);
  EXPECT_EQ(*b.last(0x81), make_frame(0x81, {0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(b.requests[0].fault_reset);
  b.enable();
}

TEST(CanopenDrive, SilenceOfTheBusIsNoticedByTime) {
  BusWithMaster b;
  b.enable();
  b.command(1, 0x0F, 300);
  const auto began_ns = b.bus.now_ns();
  while (b.nodes[0]->drive_state() == Cia402State::operation_enabled && b.bus.now_ns() - began_ns < 1'000'000'000) b.tick();
  b.tick();
  EXPECT_EQ(b.nodes[0]->drive_state(), Cia402State::fault);
  EXPECT_NEAR(static_cast<double>(b.bus.now_ns() - began_ns), 100e6, 5e6);
  EXPECT_EQ(b.requests[0].torque_Nm, 0.0);
}

TEST(CanopenDrive, AbortConnectionOptionDecides) {
  const std::vector<std::pair<int, Cia402State>> cases{{0, Cia402State::operation_enabled},
                                                       {1, Cia402State::fault},
                                                       {2, Cia402State::switch_on_disabled},
                                                       {3, Cia402State::quick_stop_active}};
  for (const auto& [option, expected] : cases) {
    BusWithMaster b;
    ASSERT_EQ(b.write(0x6007, 0, option, 2), 0U);
    ASSERT_EQ(b.write(0x605A, 0, 6, 2), 0U);
    b.enable();
    for (int i = 0; i < 4; ++i) b.sync();
    EXPECT_EQ(b.nodes[0]->drive_state(), expected) << option;
    EXPECT_EQ(b.count(0x81), 1) << option;
  }
}

/// 605A and 6085 say how a quick stop brakes, 6072 how hard at most; 65536 counts are 5 mm.
TEST(CanopenDrive, AQuickStopBrakesAsItsOptionSays) {
  struct Case {
    int option;
    double ramp_m_per_s2;
    bool stays;
  };
  for (const Case& c : {Case{2, 4.0, false}, Case{3, 0.0, false}, Case{6, 4.0, true}, Case{7, 0.0, true}}) {
    BusWithMaster b;
    EXPECT_NEAR(static_cast<double>(b.read(0x6085)) * 0.005 / 65536.0, 9.81, 1e-6);
    EXPECT_EQ(b.write(0x605A, 0, 5, 2), 0x0609'0030U);
    ASSERT_EQ(b.write(0x605A, 0, c.option, 2), 0U);
    ASSERT_EQ(b.write(0x6085, 0, 52'428'800, 4), 0U);
    ASSERT_EQ(b.write(0x6072, 0, 800, 2), 0U);
    b.enable();
    b.reports[0].velocity_m_per_s = 0.1;
    b.command(1, 0x0F, 300);
    b.command(1, 0x02, 300);
    EXPECT_TRUE(b.requests[0].quick_stop && b.requests[0].enable) << c.option;
    EXPECT_EQ(b.requests[0].torque_Nm, 0.0);
    EXPECT_NEAR(b.requests[0].brake_m_per_s2, c.ramp_m_per_s2, 1e-9) << c.option;
    EXPECT_NEAR(b.requests[0].brake_limit_Nm, 0.8 * 1.27, 1e-9);
    b.reports[0].velocity_m_per_s = 0.0;  // at rest
    for (int i = 0; i < 3; ++i) b.command(1, 0x02, 0);
    EXPECT_EQ(b.nodes[0]->drive_state(), c.stays ? Cia402State::quick_stop_active : Cia402State::switch_on_disabled);
  }
  BusWithMaster b;  // 0: off at once
  ASSERT_EQ(b.write(0x605A, 0, 0, 2), 0U);
  b.enable();
  b.reports[0].velocity_m_per_s = 0.1;
  b.command(1, 0x02, 0);
  EXPECT_FALSE(b.requests[0].enable);
}

TEST(CanopenDrive, TorqueLimitAndOffsetAct) {
  BusWithMaster b;
  ASSERT_EQ(b.write(0x6072, 0, 200, 2), 0U);
  ASSERT_EQ(b.write(0x60B2, 0, 50, 2), 0U);
  b.enable();
  b.command(1, 0x0F, 100);
  EXPECT_DOUBLE_EQ(b.requests[0].torque_Nm, 0.15 * 1.27);
  b.command(1, 0x0F, 500);
  EXPECT_DOUBLE_EQ(b.requests[0].torque_Nm, 0.2 * 1.27);
  b.command(1, 0x0F, -500);
  EXPECT_DOUBLE_EQ(b.requests[0].torque_Nm, -0.2 * 1.27);
  EXPECT_NE(load<std::uint16_t>(*b.last(0x181), 0) & 0x0800, 0);
}

TEST(CanopenDrive, TheServersGuardPutsTheDriveInFault) {
  BusWithMaster b;
  b.enable();
  b.on_tick = [&](std::size_t i) { b.reports[i].state = DriveState::fault; };
  b.command(1, 0x0F, 100);
  b.tick();
  EXPECT_EQ(b.nodes[0]->drive_state(), Cia402State::fault);
  EXPECT_EQ(load<std::uint16_t>(*b.last(0x81), 0), 0xFF01);
}

}  // namespace
}  // namespace feedtwin::io::can
