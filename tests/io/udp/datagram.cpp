#include "io/udp/datagram.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "tests/io/udp/peer.h"

namespace feedtwin::io::udp {
namespace {

using test::at;
using test::Bytes;

TEST(UdpDatagram, ARequestIsReadBackAsWritten) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const std::size_t axes = 1 + random() % max_axes;
    std::vector<test::Command> commands(axes);
    for (auto& c : commands)
      c = {std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -60), static_cast<std::uint16_t>(random()),
           static_cast<std::uint16_t>(random())};
    const auto sequence = static_cast<std::uint32_t>(random());
    const std::uint64_t stamp = random();
    Request decoded;
    ASSERT_TRUE(decode(test::request(sequence, commands, stamp), max_axes, decoded));
    ASSERT_EQ(decoded.sequence, sequence);
    ASSERT_EQ(decoded.stamp, stamp);
    ASSERT_EQ(decoded.axes, axes);
    for (std::size_t n = 0; n < axes; ++n) {
      ASSERT_EQ(decoded.axis[n].torque_Nm, commands[n].torque_Nm);
      ASSERT_EQ(decoded.axis[n].enable, (commands[n].control & 1) != 0);
      ASSERT_EQ(decoded.axis[n].quick_stop, (commands[n].control & 2) != 0);
      ASSERT_EQ(decoded.axis[n].fault_reset, (commands[n].control & 128) != 0);
      ASSERT_EQ(decoded.axis[n].watchdog_ns, commands[n].watchdog_ms * std::int64_t{1'000'000});
    }
  }
}

TEST(UdpDatagram, AnythingElseIsRefused) {
  const Bytes good = test::request(1, {{}, {}});
  Request request;
  ASSERT_TRUE(decode(good, 2, request));
  EXPECT_FALSE(decode(good, 1, request)) << "more axes than the plant has";
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(decode(std::span(good).first(size), 2, request)) << size;
  Bytes longer = good;
  longer.push_back(0);
  EXPECT_FALSE(decode(longer, 2, request));
  for (std::size_t i = 0; i < 7; ++i) {
    Bytes bad = good;
    bad[i] ^= 0x55;
    EXPECT_FALSE(decode(bad, 2, request)) << i;
  }
  Bytes none = good;
  none[6] = 0;
  none.resize(request_header_bytes);
  EXPECT_FALSE(decode(none, 2, request));
}

TEST(UdpDatagram, EveryFieldOfTheReplyIsWhereItIsDocumented) {
  AxisReport axis;
  axis.encoder_counts = -0x1234'5678'9ABC;
  axis.velocity_m_per_s = -0.125;
  axis.torque_Nm = 0.5;
  axis.input_age_ns = 77;
  axis.state = DriveState::fault;
  axis.at_high_stop = true;
  const std::array<AxisReport, 2> axes{AxisReport{.encoder_counts = 1, .input_age_ns = 55}, axis};
  std::array<std::uint8_t, largest_reply_bytes> buffer;
  buffer.fill(0xEE);
  const Reply reply{.sequence = 9, .stamp = 10, .tick = {.tick = 11, .missed_ticks = 12, .start_ns = 13}};
  const std::size_t size = encode(reply, axes, buffer);
  ASSERT_EQ(size, 48U + 2 * 32U);
  const Bytes bytes(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 8), (Bytes{'F', 'T', 'W', 'N', 1, 2, 2, 0}));
  EXPECT_EQ(at<std::uint32_t>(bytes, 8), 9U);
  EXPECT_EQ(at<std::uint64_t>(bytes, 16), 10U);
  EXPECT_EQ(at<std::uint64_t>(bytes, 24), 11U);
  EXPECT_EQ(at<std::uint64_t>(bytes, 32), 12U);
  EXPECT_EQ(at<std::int64_t>(bytes, 40), 55);
  EXPECT_EQ(at<std::int64_t>(bytes, 48), 1);
  EXPECT_EQ(at<std::int64_t>(bytes, 80), axis.encoder_counts);
  EXPECT_EQ(at<double>(bytes, 88), -0.125);
  EXPECT_EQ(at<double>(bytes, 96), 0.5);
  EXPECT_EQ(at<std::uint16_t>(bytes, 104), 0x8008);
  for (std::size_t i = 106; i < size; ++i) EXPECT_EQ(bytes[i], 0) << i;
}

TEST(UdpDatagram, AMachinesSpindleAndAuxiliaryFunctionsComeBesideItsTorques) {
  Bytes bytes = test::request(1, {{}, {}});
  const float speed_rad_per_s = 314.0F, depth_m = 2.5e-4F;
  std::memcpy(bytes.data() + 12, &speed_rad_per_s, 4);
  std::memcpy(bytes.data() + request_header_bytes + 12, &depth_m, 4);
  Request request;
  for (unsigned bits = 0; bits < 16; ++bits) {
    bytes[7] = static_cast<std::uint8_t>(bits);
    ASSERT_TRUE(decode(bytes, 2, request));
    const double sign = (bits & 3) == 1 ? 1.0 : (bits & 3) == 2 ? -1.0 : 0.0;
    EXPECT_EQ(request.machine.spindle_speed_rad_per_s, sign * 314.0) << bits;
    EXPECT_EQ(request.machine.pump, (bits & 12) != 0) << bits;
    EXPECT_FLOAT_EQ(static_cast<float>(request.machine.depth_of_cut_m), depth_m);
  }
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + 12, &nothing, 4);
  EXPECT_FALSE(decode(bytes, 2, request));
}

}  // namespace
}  // namespace feedtwin::io::udp
