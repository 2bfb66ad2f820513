#include "io/udp/udp_port.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <string>
#include <thread>

#include "io/monotonic.h"
#include "tests/io/udp/peer.h"

namespace feedtwin::io::udp {
namespace {

using test::at;
using test::Bytes;
using test::request;

constexpr std::int64_t second_ns = 1'000'000'000;

class UdpPortTest : public testing::Test {
 protected:
  UdpPortTest() : port_({.port = 0, .command_idle_ns = 500'000'000}, context()) { port_.open(); }
  static PortContext context() {
    PortContext context;
    context.axes = 2;
    return context;
  }
  /// One free-running tick.
  std::uint64_t tick() {
    const std::uint64_t fresh = port_.receive(newest_);
    port_.send({.tick = ++ticks_, .missed_ticks = 0, .start_ns = 0}, reports_);
    return fresh;
  }
  bool step() { return port_.wait_for_request(monotonic_ns() + second_ns / 50) && tick() != 0; }
  std::uint64_t counter(const std::string& name) const {
    for (const Counter& c : port_.counters())
      if (c.name == "udp_" + name) return c.value;
    ADD_FAILURE() << "no counter " << name;
    return 0;
  }

  UdpPort port_;
  std::array<AxisRequest, 2> newest_{};
  std::array<AxisReport, 2> reports_{};
  std::uint64_t ticks_ = 0;
};

TEST_F(UdpPortTest, FreeRunningTheNewestActsAndIsAnsweredOnce) {
  test::Peer peer(port_.udp_port());
  EXPECT_EQ(tick(), 0U);
  const std::int64_t before_ns = monotonic_ns();
  ASSERT_TRUE(peer.send(request(1, {{0.1}, {0.2}}, 111)) && peer.send(request(2, {{0.3}, {0.4}}, 222)));
  EXPECT_EQ(tick(), 3U);
  EXPECT_EQ(newest_[0].torque_Nm, 0.3);
  EXPECT_EQ(newest_[1].torque_Nm, 0.4);
  EXPECT_GE(newest_[0].arrival_ns, before_ns - second_ns / 100);
  EXPECT_LE(newest_[0].arrival_ns, monotonic_ns());
  EXPECT_EQ(newest_[0].superseded, 1U);
  const auto reply = peer.receive();
  ASSERT_TRUE(reply);
  EXPECT_EQ(at<std::uint32_t>(*reply, 8), 2U);
  EXPECT_EQ(at<std::uint64_t>(*reply, 16), 222U);
  EXPECT_EQ(at<std::uint64_t>(*reply, 24), 2U);
  EXPECT_EQ(counter("superseded"), 1U);
  EXPECT_EQ(tick(), 0U);
  EXPECT_FALSE(peer.receive(5)) << "nothing asked, nothing said";
}

TEST_F(UdpPortTest, FewerAxesLeaveTheOthers) {
  test::Peer peer(port_.udp_port());
  peer.send(request(1, {{0.1}, {0.2}}));
  peer.send(request(2, {{0.3}}));
  EXPECT_EQ(tick(), 3U);
  EXPECT_EQ(newest_[0].torque_Nm, 0.3);
  EXPECT_EQ(newest_[1].torque_Nm, 0.2);
  peer.send(request(3, {{0.5}}));
  EXPECT_EQ(tick(), 1U);
}

TEST_F(UdpPortTest, LockstepMakesOneTickOfEachRequestAndNoneOfADuplicate) {
  test::Peer peer(port_.udp_port());
  EXPECT_FALSE(port_.wait_for_request(monotonic_ns() + 1'000'000));
  for (const std::uint32_t sequence : {1U, 2U, 3U}) peer.send(request(sequence, {{0.1 * sequence}}, sequence));
  for (const std::uint32_t sequence : {1U, 2U, 3U}) {
    ASSERT_TRUE(step());
    EXPECT_DOUBLE_EQ(newest_[0].torque_Nm, 0.1 * sequence);
    const auto reply = peer.receive();
    ASSERT_TRUE(reply);
    EXPECT_EQ(at<std::uint32_t>(*reply, 8), sequence);
    EXPECT_EQ(at<std::uint64_t>(*reply, 24), sequence);
  }
  peer.send(request(3, {{9.0}}));
  EXPECT_FALSE(step());
  const auto again = peer.receive();
  ASSERT_TRUE(again) << "the reply to a repeated request is sent again";
  EXPECT_EQ(at<std::uint64_t>(*again, 24), 3U);
  EXPECT_DOUBLE_EQ(newest_[0].torque_Nm, 0.1 * 3);
  peer.send(request(2, {{9.0}}));
  EXPECT_FALSE(step());
  EXPECT_FALSE(peer.receive(5));
  EXPECT_EQ(counter("duplicates"), 1U);
  EXPECT_EQ(counter("late"), 1U);
  EXPECT_EQ(counter("repeated_replies"), 1U);
  EXPECT_EQ(ticks_, 3U);
}

TEST_F(UdpPortTest, LockstepOverALossyLineIsTheSameRunAsOverAGoodOne) {
  // the controller repeats a request until its reply has come; requests and replies get lost on the way
  std::atomic<bool> stop{false};
  double sum = 0.0;
  std::thread plant([&] {
    while (!stop) {
      if (!port_.wait_for_request(monotonic_ns() + second_ns / 100)) continue;
      port_.receive(newest_);
      sum = 0.5 * sum + newest_[0].torque_Nm;
      reports_[0].torque_Nm = sum;
      port_.send({.tick = ++ticks_, .missed_ticks = 0, .start_ns = 0}, reports_);
    }
  });
  test::Peer peer(port_.udp_port());
  std::mt19937 random(11);
  double expected = 0.0;
  for (std::uint32_t sequence = 1; sequence <= 300; ++sequence) {
    const double torque = 0.001 * sequence;
    expected = 0.5 * expected + torque;
    std::optional<Bytes> reply;
    for (int attempt = 0; attempt < 200 && !reply; ++attempt) {
      if (random() % 3 != 0) peer.send(request(sequence, {{torque}}, sequence));
      if (random() % 8 == 0) peer.send(request(sequence - 1, {{torque}}, sequence));  // a late one, overtaken
      reply = peer.receive(5);
      if (reply && (random() % 3 == 0 || at<std::uint32_t>(*reply, 8) != sequence)) reply.reset();  // lost, or an old one
    }
    ASSERT_TRUE(reply) << sequence;
    ASSERT_EQ(at<double>(*reply, 64), expected) << sequence;
    ASSERT_EQ(at<std::uint64_t>(*reply, 24), sequence);
  }
  stop = true;
  plant.join();
  EXPECT_GT(counter("duplicates"), 0U);
}

TEST_F(UdpPortTest, ASecondControllerIsRefusedUntilTheFirstIsSilent) {
  test::Peer first(port_.udp_port()), second(port_.udp_port());
  first.send(request(500, {{0.1}}));
  EXPECT_EQ(tick(), 1U);
  second.send(request(1, {{0.2}}));
  EXPECT_EQ(tick(), 0U);
  EXPECT_EQ(counter("refused"), 1U);
  std::this_thread::sleep_for(std::chrono::milliseconds(510));
  const auto sequence = newest_[0].sequence;
  second.send(request(1, {{0.2}}));
  EXPECT_EQ(tick(), 1U);
  EXPECT_EQ(newest_[0].torque_Nm, 0.2);
  EXPECT_GT(newest_[0].sequence - sequence, 1000U);
}

TEST_F(UdpPortTest, RubbishIsCountedAndAFloodIsBounded) {
  test::Peer peer(port_.udp_port());
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    Bytes bytes(random() % 500);  // all of them fit into the socket's buffer
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    ASSERT_TRUE(peer.send(bytes));
  }
  EXPECT_EQ(tick(), 0U);
  EXPECT_EQ(counter("malformed"), std::uint64_t{UdpPort::most_datagrams}) << "the rest is for the next ticks";
  for (int i = 0; i < 20 && counter("malformed") < 100; ++i) EXPECT_FALSE(step());
  EXPECT_EQ(counter("malformed"), 100U);
  peer.send(request(1, {{0.1}}));
  EXPECT_EQ(tick(), 1U);
}

TEST_F(UdpPortTest, WhatTheKernelHadNoRoomForIsCounted) {
  test::Peer peer(port_.udp_port());
  for (std::uint32_t i = 1; i < 5000; ++i) peer.send(request(i, {{0.1}, {0.1}}));
  for (int i = 0; i < 200; ++i) tick();
  peer.send(request(6000, {{0.1}}));  // the kernel tells with the next datagram that it takes
  tick();
  EXPECT_GT(counter("overflowed"), 0U);
  EXPECT_EQ(counter("overflowed") + counter("datagrams"), 5000U);
}

TEST_F(UdpPortTest, APortInUseIsSaidInOneLine) {
  UdpPort second({.port = port_.udp_port()}, context());
  try {
    second.open();
    FAIL() << "opened twice";
  } catch (const PortError& error) {
    EXPECT_EQ(error.what(), "udp: 127.0.0.1:" + std::to_string(port_.udp_port()) + ": already in use by another program");
  }
  UdpPort nowhere({.address = "192.0.2.1"}, context());
  EXPECT_THROW(nowhere.open(), PortError);
  port_.close();
  port_.close();
  second.open();
}

}  // namespace
}  // namespace feedtwin::io::udp
