#include "io/can/canopen_node.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/io/can/bus_master.h"

namespace feedtwin::io::can {
namespace {

TEST(CanopenObjects, PdosAreRemappedByTheStandardsProcedureOnly) {
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

TEST(CanopenObjects, GapsAndEventDrivenPdosWork) {
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

TEST(CanopenObjects, ShortAndRemoteRpdosAreRefusedAndSaid) {
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

TEST(CanopenObjects, AMachinesSpindleAndAuxiliaryFunctionsByObjectAndByPdo) {
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

}  // namespace
}  // namespace feedtwin::io::can
