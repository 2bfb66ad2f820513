#include "io/modbus/register_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace feedtwin::io::modbus {
namespace {

std::array<std::uint16_t, input_stride> encoded(const TickReport& tick, const AxisReport& axis, double rated_Nm = 1.27) {
  std::array<std::uint16_t, input_stride> registers;
  registers.fill(0xDEAD);
  encode(tick, axis, rated_Nm, registers);
  return registers;
}

TEST(RegisterMap, OneLinearSumRebuildsTheSignedPosition) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> counts(std::numeric_limits<std::int32_t>::min(),
                                                     std::numeric_limits<std::int32_t>::max());
  for (int i = 0; i < 100'000; ++i) {
    AxisReport axis;
    axis.encoder_counts =
        i < 4 ? std::array<std::int64_t, 4>{0, -1, INT32_MIN, INT32_MAX}[static_cast<std::size_t>(i)] : counts(random);
    const auto r = encoded({}, axis);
    ASSERT_EQ(r[1] + 65536.0 * r[2] - 2147483648.0, static_cast<double>(axis.encoder_counts));
    ASSERT_EQ(static_cast<std::int32_t>(r[12] * 65536U + r[13]), axis.encoder_counts) << "high word first";
    ASSERT_EQ(static_cast<std::int32_t>(r[15] * 65536U + r[14]), axis.encoder_counts) << "low word first";
  }
}

TEST(RegisterMap, BeyondInt32TheCountsWrapAndStayContinuous) {
  AxisReport axis;
  axis.encoder_counts = std::int64_t{INT32_MAX} + 1;
  const auto r = encoded({}, axis);
  EXPECT_EQ(r[1], 0);
  EXPECT_EQ(r[2], 0);
  EXPECT_EQ(static_cast<std::int32_t>(r[12] * 65536U + r[13]), INT32_MIN);
}

TEST(RegisterMap, EveryRegisterIsWhereItIsDocumented) {
  const TickReport tick{.tick = 0x1'2345'6789, .missed_ticks = 0x0003'0002, .start_ns = 0};
  AxisReport axis;
  axis.velocity_m_per_s = -0.25;
  axis.torque_Nm = 0.635;
  axis.input_age_ns = 1'234'999;
  axis.sequence = 0x5'0007;
  axis.state = DriveState::enabled;
  const auto r = encoded(tick, axis);
  EXPECT_EQ(r[0], 0x6789);
  EXPECT_EQ(r[3], r[0]);
  EXPECT_EQ(r[4], 0x27);
  EXPECT_EQ(static_cast<std::int16_t>(r[5]), -2500);
  EXPECT_EQ(static_cast<std::int16_t>(r[6]), 5000);
  EXPECT_EQ(r[7], 1234);
  EXPECT_EQ(r[8], 0x6789);
  EXPECT_EQ(r[9], 0x2345);
  EXPECT_EQ(r[10], 2);
  EXPECT_EQ(r[11], 3);
  EXPECT_EQ(static_cast<std::int32_t>(r[16] * 65536U + r[17]), -250'000);
  EXPECT_EQ(static_cast<std::int32_t>(r[19] * 65536U + r[18]), -250'000);
  EXPECT_EQ(r[20], 7);
  EXPECT_EQ(r[21], 16384);
  for (std::size_t i = 22; i < input_stride; ++i) EXPECT_EQ(r[i], 0) << i;
}

TEST(RegisterMap, WhatDoesNotFitIsLimited) {
  AxisReport axis;
  axis.velocity_m_per_s = 10.0;
  axis.torque_Nm = -1e3;
  axis.input_age_ns = 1'000'000'000;
  auto r = encoded({}, axis);
  EXPECT_EQ(static_cast<std::int16_t>(r[5]), 32767);
  EXPECT_EQ(static_cast<std::int16_t>(r[6]), -32768);
  EXPECT_EQ(r[7], 65535);
  EXPECT_EQ(static_cast<std::int32_t>(r[16] * 65536U + r[17]), 10'000'000);
  axis.velocity_m_per_s = std::nan("");
  axis.torque_Nm = -std::numeric_limits<double>::infinity();
  axis.input_age_ns = -1;
  r = encoded({}, axis);
  EXPECT_EQ(r[5], 0);
  EXPECT_EQ(static_cast<std::int16_t>(r[6]), -32768);
  EXPECT_EQ(r[7], 65535) << "no command yet";
}

TEST(RegisterMap, StatesAreTheCodesOfCiA402) {
  const auto status = [](DriveState state) {
    AxisReport axis;
    axis.state = state;
    return encoded({}, axis)[4];
  };
  EXPECT_EQ(status(DriveState::disabled) & 0x4F, 0x40);
  EXPECT_EQ(status(DriveState::enabled) & 0x6F, 0x27);
  EXPECT_EQ(status(DriveState::quick_stop) & 0x6F, 0x07);
  EXPECT_EQ(status(DriveState::fault) & 0x4F, 0x08);
  AxisReport axis;
  axis.index_passed = axis.at_low_stop = true;
  EXPECT_EQ(encoded({}, axis)[4], 0x0040 | 1 << 12 | 1 << 14);
}

AxisRequest decoded(std::uint16_t torque, std::uint16_t control = 0, std::uint16_t watchdog = 0) {
  std::array<std::uint16_t, holding_stride> registers{};
  registers[0] = torque;
  registers[1] = control;
  registers[3] = watchdog;
  return request_from(registers, 1.27);
}

TEST(RegisterMap, TorqueIsInHundredthsOfAPercentAndClippedAtRated) {
  EXPECT_DOUBLE_EQ(decoded(5000).torque_Nm, 0.635);
  EXPECT_DOUBLE_EQ(decoded(static_cast<std::uint16_t>(-1)).torque_Nm, -1e-4 * 1.27);
  EXPECT_DOUBLE_EQ(decoded(static_cast<std::uint16_t>(-32768)).torque_Nm, -1.27);
  EXPECT_DOUBLE_EQ(decoded(10001).torque_Nm, 1.27);
  EXPECT_FALSE(torque_is_clipped(10000));
  EXPECT_TRUE(torque_is_clipped(10001));
  EXPECT_FALSE(torque_is_clipped(static_cast<std::uint16_t>(-10000)));
  EXPECT_TRUE(torque_is_clipped(static_cast<std::uint16_t>(-10001)));
}

TEST(RegisterMap, ControlBits) {
  for (unsigned bits = 0; bits < 256; ++bits) {
    const auto request = decoded(0, static_cast<std::uint16_t>(bits), 250);
    ASSERT_EQ(request.enable, (bits & 1) != 0);
    ASSERT_EQ(request.quick_stop, (bits & 2) != 0);
    ASSERT_EQ(request.fault_reset, (bits & 128) != 0);
    ASSERT_EQ(request.watchdog_ns, 250'000'000);
  }
}

TEST(RegisterMap, AnalogScaleIsTenVoltsForRatedTorque) {
  EXPECT_EQ(torque_from_analog(32767), 10000);
  EXPECT_EQ(static_cast<std::int16_t>(torque_from_analog(static_cast<std::uint16_t>(-32767))), -10000);
  EXPECT_EQ(torque_from_analog(0), 0);
  for (int torque = -10000; torque <= 10000; ++torque)
    ASSERT_EQ(static_cast<std::int16_t>(torque_from_analog(analog_from_torque(static_cast<std::uint16_t>(torque)))), torque);
}

TEST(RegisterMap, AMachinesRegistersBecomeItsRequest) {
  std::array<std::uint16_t, holding_stride> registers{};
  registers[8] = 3000;
  registers[10] = 250;
  for (std::uint16_t bits = 0; bits < 16; ++bits) {
    registers[9] = bits;
    const auto request = machine_request_from(registers);
    const double sign = (bits & 3) == 1 ? 1.0 : (bits & 3) == 2 ? -1.0 : 0.0;
    EXPECT_NEAR(request.spindle_speed_rad_per_s, sign * 314.159265, 1e-6) << bits;
    EXPECT_EQ(request.pump, (bits & 12) != 0) << bits;
    EXPECT_DOUBLE_EQ(request.depth_of_cut_m, 250e-6);
    EXPECT_FALSE(request.path_engagement);
  }
}

}  // namespace
}  // namespace feedtwin::io::modbus
