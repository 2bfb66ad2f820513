#include "io/can/canopen_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "io/can/frame_bits.h"
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

TEST(CanopenNode, TorqueIsLatchedAtSync) {
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

TEST(CanopenNode, MissingCommandsTakeTheTorqueAwayAndSayWhy) {
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

TEST(CanopenNode, SilenceOfTheBusIsNoticedByTime) {
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

TEST(CanopenNode, AbortConnectionOptionDecides) {
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

TEST(CanopenNode, PdosAreRemappedByTheStandardsProcedureOnly) {
  BusWithMaster b;
  // while the PDO exists: refused
  EXPECT_EQ(b.write(0x1A00, 0, 0, 1), 0x06010000U);
  EXPECT_EQ(b.write(0x1800, 1, 0x190, 4), 0x06090030U);
  ASSERT_EQ(b.write(0x1800, 1, 0xC0000181, 4), 0U);
  EXPECT_EQ(b.write(0x1A00, 1, 0x60FD0020, 4), 0x06010003U);  // the count is not 0
  ASSERT_EQ(b.write(0x1A00, 0, 0, 1), 0U);
  EXPECT_EQ(b.write(0x1A00, 1, 0x60400010, 4), 0x06040041U);  // not out of the drive
  EXPECT_EQ(b.write(0x1A00, 1, 0x60FD0010, 4), 0x06040041U);  // wrong length
  EXPECT_EQ(b.write(0x1A00, 1, 0x5FFF0010, 4), 0x06020000U);
  ASSERT_EQ(b.write(0x1A00, 1, 0x60FD0020, 4), 0U);
  ASSERT_EQ(b.write(0x1A00, 2, 0x60640020, 4), 0U);
  ASSERT_EQ(b.write(0x1A00, 3, 0x60410010, 4), 0U);
  EXPECT_EQ(b.write(0x1A00, 0, 3, 1), 0x06040042U);  // 10 bytes
  ASSERT_EQ(b.write(0x1A00, 0, 2, 1), 0U);
  EXPECT_EQ(b.write(0x1800, 1, 0x40000000 + 0x601, 4), 0x06090030U);  // an identifier of other services
  ASSERT_EQ(b.write(0x1800, 1, 0x40000000 + 0x1A5, 4), 0U);
  b.nmt(1);
  b.reports[0].encoder_counts = 77;
  b.reports[0].at_high_stop = true;
  b.tick();
  b.heard.clear();
  b.sync();
  EXPECT_EQ(*b.last(0x1A5), make_frame(0x1A5, {2, 0, 0, 0, 77, 0, 0, 0}));
  EXPECT_EQ(b.count(0x181), 0);
}

TEST(CanopenNode, GapsAndEventDrivenPdosWork) {
  BusWithMaster b;
  // RPDO 2: torque after a gap of two bytes, at once
  ASSERT_EQ(b.write(0x1601, 1, 0x00060010, 4), 0U);
  ASSERT_EQ(b.write(0x1601, 2, 0x60710010, 4), 0U);
  ASSERT_EQ(b.write(0x1601, 0, 2, 1), 0U);
  ASSERT_EQ(b.write(0x1401, 2, 255, 1), 0U);
  ASSERT_EQ(b.write(0x1401, 1, 0x301, 4), 0U);
  ASSERT_EQ(b.write(0x1802, 2, 254, 1), 0U);  // TPDO 3: statusword on change and every 20 ms
  ASSERT_EQ(b.write(0x1802, 5, 20, 2), 0U);
  ASSERT_EQ(b.write(0x1A02, 1, 0x60410010, 4), 0U);
  ASSERT_EQ(b.write(0x1A02, 0, 1, 1), 0U);
  ASSERT_EQ(b.write(0x1802, 1, 0x40000381, 4), 0U);
  b.enable();
  b.say(make_frame(0x301, {9, 9, 100, 0}));
  b.tick();
  EXPECT_DOUBLE_EQ(b.requests[0].torque_Nm, 0.1 * 1.27);
  b.heard.clear();
  for (int i = 0; i < 40; ++i) b.command(1, 0x0F, 0);  // 60 ms
  EXPECT_NEAR(b.count(0x381), 3, 1);
  b.heard.clear();
  b.command(1, 0x06, 0);
  EXPECT_EQ(b.count(0x381), 1);
}

TEST(CanopenNode, ShortAndRemoteRpdosAreRefusedAndSaid) {
  BusWithMaster b;
  b.enable();
  b.heard.clear();
  b.say(make_frame(0x201, {0x0F, 0, 1}));
  b.command(1, 0x0F, 0);
  EXPECT_EQ(b.nodes[0]->counters().wrong_length, 1U);
  EXPECT_EQ(load<std::uint16_t>(*b.last(0x81), 0), 0x8210);
  b.say(make_frame(0x201, {0x0F, 0, 1, 0, 8}));  // a mode that there is not: that value alone is refused
  b.sync();
  EXPECT_EQ(b.nodes[0]->counters().refused_values, 1U);
  EXPECT_DOUBLE_EQ(b.requests[0].torque_Nm, 0.001 * 1.27);
}

TEST(CanopenNode, TorqueLimitAndOffsetAct) {
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

TEST(CanopenNode, TheServersGuardPutsTheDriveInFault) {
  BusWithMaster b;
  b.enable();
  b.on_tick = [&](std::size_t i) { b.reports[i].state = DriveState::fault; };
  b.command(1, 0x0F, 100);
  b.tick();
  EXPECT_EQ(b.nodes[0]->drive_state(), Cia402State::fault);
  EXPECT_EQ(load<std::uint16_t>(*b.last(0x81), 0), 0xFF01);
}

TEST(CanopenNode, BusOffIsSurvivedAndSaid) {
  BusWithMaster b;
  b.enable();
  b.bus.set_off(true);
  for (int i = 0; i < 5; ++i) b.tick();
  b.bus.set_off(false);
  b.tick();
  EXPECT_EQ(load<std::uint16_t>(*b.last(0x81), 0), 0x8140);
  EXPECT_EQ(b.port->totals().recoveries, 1U);
  b.command(1, 0x00, 0);
  b.command(1, 0x80, 0);
  b.enable();
}

/// Whatever is lost, late or doubled on the bus, torque acts only in operation enabled, and the drive can be had back.
TEST(CanopenNode, KeepsItsPromisesOnABadBus) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    BusWithMaster b;
    b.bus.set_faults({.loss = 0.2, .duplicate = 0.1, .delay_ns = 3'000'000, .seed = seed});
    std::mt19937_64 random(seed);
    for (int i = 0; i < 1500; ++i) {
      const int words[] = {0x06, 0x07, 0x0F, 0x0F, 0x0F, 0x80, 0x02, 0x00};
      if (random() % 20 == 0) b.nmt(random() % 5 == 0 ? 2 : 1);
      b.command(1, words[random() % 8], static_cast<int>(random() % 2000) - 1000);
      const bool on = b.nodes[0]->drive_state() == Cia402State::operation_enabled;
      ASSERT_TRUE(on || b.requests[0].torque_Nm == 0.0) << "seed " << seed << " step " << i;
    }
    b.bus.set_faults({});
    for (int i = 0; i < 10; ++i) b.tick();
    b.nmt(1);
    b.command(1, 0x00, 0);
    b.command(1, 0x80, 0);
    b.enable();
  }
}

TEST(CanopenNode, SixtyFourAxesShareABus) {
  BusWithMaster b(64, 1e9);
  b.enable_all();
  for (int node = 1; node <= 64; ++node) b.say(make_frame(0x200 + node, {0x0F, 0, node, 0, 10}));
  b.sync();
  for (std::size_t i = 0; i < 64; ++i) EXPECT_NEAR(b.requests[i].torque_Nm, 1.27e-3 * static_cast<double>(i + 1), 1e-12);
  EXPECT_EQ(b.port->totals().lost, 0U);
}

/// Three axes at 1 kHz, every cycle with its SYNC, RPDO 1 and TPDO 1 a node, TPDO 2 every tenth: counted bit by bit.
TEST(CanopenNode, ThreeAxesFitIntoOneMegabit) {
  BusWithMaster b(3);
  b.enable_all();
  const auto busy_ns = b.bus.busy_ns();
  const auto frames = b.bus.frames();
  std::mt19937 random(5);
  constexpr int cycles = 1000;
  std::int64_t most_ns = 0;
  for (int i = 0; i < cycles; ++i) {
    const auto before_ns = b.bus.busy_ns();
    for (std::size_t n = 0; n < 3; ++n) {
      b.reports[n].encoder_counts = static_cast<std::int32_t>(random());
      b.reports[n].torque_Nm = (static_cast<double>(random() % 4000) - 2000.0) * 1e-3;
    }
    for (int node = 1; node <= 3; ++node) {
      const int torque = static_cast<int>(random() % 2000) - 1000;
      b.say(make_frame(0x200 + node, {0x0F, 0, torque & 0xFF, torque >> 8 & 0xFF, 10}));
    }
    b.sync();
    most_ns = std::max(most_ns, b.bus.busy_ns() - before_ns);
  }
  EXPECT_EQ(b.bus.frames() - frames, cycles * 7U + cycles / 10 * 3);
  for (auto* node : b.nodes) EXPECT_EQ(node->counters().superseded + node->counters().command_losses, 0U);
  EXPECT_LT(most_ns, 1'000'000);
  // the worst case, whatever the content: at most one of the slow PDOs in a cycle
  const int worst =
      most_bits_on_the_wire(0) + 3 * (most_bits_on_the_wire(5) + most_bits_on_the_wire(8)) + most_bits_on_the_wire(7);
  EXPECT_LE(most_ns, worst * 1000);
  EXPECT_LT(worst, 1000);
  RecordProperty("mean_us_per_cycle", static_cast<int>((b.bus.busy_ns() - busy_ns) / cycles / 1000));
  RecordProperty("most_us_per_cycle", static_cast<int>(most_ns / 1000));
  std::printf("[   bits   ] three axes at 1 Mbit/s: mean %.0f us, most %.0f us of each 1000 us; worst case %d bits\n",
              static_cast<double>(b.bus.busy_ns() - busy_ns) / cycles / 1e3, static_cast<double>(most_ns) / 1e3, worst);
}

TEST(CanopenNode, AMachinesSpindleAndAuxiliaryFunctionsByObjectAndByPdo) {
  BusWithMaster b(2);
  MachineRequest machine;
  ASSERT_EQ(b.write(0x2010, 0, 3000, 2), 0U);
  ASSERT_EQ(b.write(0x2011, 0, 0x6, 1), 0U);  // M4, M7
  ASSERT_EQ(b.write(0x2012, 0, 250, 2), 0U);
  EXPECT_EQ(b.write(0x2011, 0, 16, 1), 0x0609'0031U);
  ASSERT_TRUE(b.port->receive_machine(machine));
  EXPECT_NEAR(machine.spindle_speed_rad_per_s, -314.159265, 1e-6);
  EXPECT_TRUE(machine.pump);
  EXPECT_DOUBLE_EQ(machine.depth_of_cut_m, 250e-6);
  EXPECT_FALSE(b.port->receive_machine(machine)) << "nothing new";
  // into RPDO 2, as a master maps it
  for (const auto& [index, sub, value, length] : std::initializer_list<std::array<std::int64_t, 4>>{
           {0x1601, 1, 0x2010'0010, 4}, {0x1601, 2, 0x2011'0008, 4}, {0x1601, 0, 2, 1}, {0x1401, 1, 0x301, 4}}) {
    ASSERT_EQ(b.write(static_cast<int>(index), static_cast<int>(sub), value, static_cast<int>(length)), 0U) << index << sub;
  }
  b.nmt(1);
  b.say(make_frame(0x301, {0x58, 0x02, 0x01}));
  b.sync();
  ASSERT_TRUE(b.port->receive_machine(machine));
  EXPECT_NEAR(machine.spindle_speed_rad_per_s, 62.8318531, 1e-6);
  EXPECT_FALSE(machine.pump);
}

TEST(CanopenNode, OnABusThatOnlyListensADriveAnswersAndItsTorqueIsNotUsed) {
  BusWithMaster b;
  b.another_commands = true;
  b.nmt(0x81);
  EXPECT_EQ(b.last(0x701), make_frame(0x701, {0}));
  EXPECT_EQ(b.read(0x1000), 0x0002'0192);
  b.enable();
  b.reports[0].encoder_counts = 1234;
  b.tick();
  b.heard.clear();
  b.command(1, 0x0F, 500);
  ASSERT_EQ(b.count(0x181), 1);
  EXPECT_EQ(load<std::int32_t>(*b.last(0x181), 2), 1234);
  EXPECT_EQ(b.requests[0].torque_Nm, 0.0);
  EXPECT_GT(b.port->totals().not_in_command, 0U);
}

}  // namespace
}  // namespace feedtwin::io::can
