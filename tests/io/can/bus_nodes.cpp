#include "io/can/bus_nodes.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "io/can/frame_bits.h"
#include "tests/io/can/bus_master.h"

namespace feedtwin::io::can {
namespace {

TEST(BusNodes, BusOffIsSurvivedAndSaid) {
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
TEST(BusNodes, KeepsItsPromisesOnABadBus) {
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

TEST(BusNodes, SixtyFourAxesShareABus) {
  BusWithMaster b(64, 1e9);
  b.enable_all();
  for (int node = 1; node <= 64; ++node) b.say(make_frame(0x200 + node, {0x0F, 0, node, 0, 10}));
  b.sync();
  for (std::size_t i = 0; i < 64; ++i) EXPECT_NEAR(b.requests[i].torque_Nm, 1.27e-3 * static_cast<double>(i + 1), 1e-12);
  EXPECT_EQ(b.port->totals().lost, 0U);
}

/// Three axes at 1 kHz, every cycle with its SYNC, RPDO 1 and TPDO 1 a node, TPDO 2 every tenth: counted bit by bit.
TEST(BusNodes, ThreeAxesFitIntoOneMegabit) {
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

TEST(BusNodes, OnABusThatOnlyListensADriveAnswersAndItsTorqueIsNotUsed) {
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
  EXPECT_GT(b.port->not_in_command(), 0U);
}

}  // namespace
}  // namespace feedtwin::io::can
