#include "io/can/drive_state.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace feedtwin::io::can {
namespace {

using enum Cia402State;

// CiA 402-2, the transitions as the standard's figure has them, written down apart from the code: from, controlword's mask
// and value, to.
struct Transition {
  Cia402State from;
  int mask, value;
  Cia402State to;
};
const std::vector<Transition> transitions{
    {switch_on_disabled, 0x87, 0x06, ready_to_switch_on},  // 2
    {ready_to_switch_on, 0x87, 0x07, switched_on},         // 3
    {switched_on, 0x8F, 0x0F, operation_enabled},          // 4
    {operation_enabled, 0x8F, 0x07, switched_on},          // 5
    {switched_on, 0x87, 0x06, ready_to_switch_on},         // 6
    {ready_to_switch_on, 0x82, 0x00, switch_on_disabled},  // 7, disable voltage
    {ready_to_switch_on, 0x86, 0x02, switch_on_disabled},  // 7, quick stop
    {operation_enabled, 0x87, 0x06, ready_to_switch_on},   // 8
    {operation_enabled, 0x82, 0x00, switch_on_disabled},   // 9
    {switched_on, 0x82, 0x00, switch_on_disabled},         // 10
    {switched_on, 0x86, 0x02, switch_on_disabled},         // 10
    {operation_enabled, 0x86, 0x02, quick_stop_active},    // 11
    {quick_stop_active, 0x82, 0x00, switch_on_disabled},   // 12
};

DriveStateMachine machine_in(Cia402State state) {
  DriveStateMachine machine;
  const std::map<Cia402State, std::vector<int>> ways{{switch_on_disabled, {}},
                                                     {ready_to_switch_on, {0x06}},
                                                     {switched_on, {0x06, 0x07}},
                                                     {operation_enabled, {0x06, 0x07, 0x0F}},
                                                     {quick_stop_active, {0x06, 0x07, 0x0F, 0x02}}};
  if (state == fault) {
    machine.fault({});
    return machine;
  }
  for (const int word : ways.at(state)) (void)machine.step(static_cast<std::uint16_t>(word), false, {});
  return machine;
}

TEST(DriveState, TakesTheStandardsTransitionsAndNoOthers) {
  for (const auto from :
       {switch_on_disabled, ready_to_switch_on, switched_on, operation_enabled, quick_stop_active, fault}) {
    for (int word = 0; word < 0x100; ++word) {
      auto machine = machine_in(from);
      ASSERT_EQ(machine.state(), from);
      auto expected = from;
      for (const auto& t : transitions) {
        if (t.from == from && (word & t.mask) == t.value) expected = t.to;
      }
      if (from == fault && (word & 0x80) != 0) expected = switch_on_disabled;  // 15, bit 7 was low before
      (void)machine.step(static_cast<std::uint16_t>(word), false, {});
      EXPECT_EQ(machine.state(), expected) << "from " << static_cast<int>(from) << " by " << std::hex << word;
    }
  }
}

TEST(DriveState, StatuswordShowsTheStandardsPatterns) {
  const auto shown = [](Cia402State state) { return machine_in(state).status_bits(); };
  EXPECT_EQ(shown(switch_on_disabled) & 0x4F, 0x40);
  EXPECT_EQ(shown(ready_to_switch_on) & 0x6F, 0x21);
  EXPECT_EQ(shown(switched_on) & 0x6F, 0x23);
  EXPECT_EQ(shown(operation_enabled) & 0x6F, 0x27);
  EXPECT_EQ(shown(quick_stop_active) & 0x6F, 0x07);
  EXPECT_EQ(shown(fault) & 0x4F, 0x08);
  auto braking = machine_in(operation_enabled);
  braking.fault({.fault_reaction = 2});
  EXPECT_EQ(braking.status_bits() & 0x4F, 0x0F);
}

TEST(DriveState, FaultIsResetByTheRisingEdgeOnly) {
  auto machine = machine_in(operation_enabled);
  (void)machine.step(0x8F, false, {});  // bit 7 is high already when the fault comes
  machine.fault({});
  EXPECT_FALSE(machine.step(0x80, true, {}));
  EXPECT_EQ(machine.state(), fault);
  EXPECT_FALSE(machine.step(0x00, true, {}));
  EXPECT_TRUE(machine.step(0x80, true, {}));
  EXPECT_EQ(machine.state(), switch_on_disabled);
}

TEST(DriveState, QuickStopOptionsDecideWhereItEnds) {
  auto at_once = machine_in(operation_enabled);
  (void)at_once.step(0x02, false, {.quick_stop = 0});
  EXPECT_EQ(at_once.state(), switch_on_disabled);
  auto at_standstill = machine_in(quick_stop_active);
  (void)at_standstill.step(0x02, false, {.quick_stop = 2});
  EXPECT_EQ(at_standstill.state(), quick_stop_active);
  (void)at_standstill.step(0x02, true, {.quick_stop = 2});
  EXPECT_EQ(at_standstill.state(), switch_on_disabled);
  auto stays = machine_in(quick_stop_active);
  (void)stays.step(0x02, true, {.quick_stop = 6});
  EXPECT_EQ(stays.state(), quick_stop_active);
  (void)stays.step(0x0F, true, {.quick_stop = 6});
  EXPECT_EQ(stays.state(), operation_enabled);
}

TEST(DriveState, NoSequenceOfWordsEnablesAFaultyDriveWithoutAReset) {
  std::mt19937 random(3);
  for (int run = 0; run < 2000; ++run) {
    DriveStateMachine machine = machine_in(operation_enabled);
    machine.fault({.fault_reaction = run % 2 == 0 ? 0 : 2});
    bool reset = false;
    for (int i = 0; i < 50; ++i) {
      const auto word = static_cast<std::uint16_t>(random() % 0x100);
      reset = machine.step(word, random() % 2 == 0, {}) || reset;
      if (!reset) {
        ASSERT_FALSE(machine.operating()) << "run " << run << " step " << i;
      }
    }
  }
}

}  // namespace
}  // namespace feedtwin::io::can
