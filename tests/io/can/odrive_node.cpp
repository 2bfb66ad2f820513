#include "io/can/odrive_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace feedtwin::io::can {
namespace {

constexpr int node_id = 3;

Frame message(int command, std::uint32_t low = 0, std::uint32_t high = 0, int length = 8) {
  Frame frame;
  frame.id = static_cast<std::uint16_t>(node_id << 5 | command);
  frame.length = static_cast<std::uint8_t>(length);
  store(frame, 0, low);
  store(frame, 4, high);
  return frame;
}
Frame torque(float value_Nm) {
  Frame frame = message(0x0E, 0, 0, 4);
  store(frame, 0, value_Nm);
  return frame;
}

class Odrive : public testing::Test {
 protected:
  Odrive() : node(OdriveSettings{.node_id = node_id}) {}
  void say(const Frame& frame) { node.accept(frame, now_ns, out); }
  void tick() {
    now_ns += 1'000'000;
    node.take_request(request);
    axis.sequence = request.sequence;
    node.report(axis, now_ns, out);
  }
  std::vector<Frame> heard(int command) {
    std::vector<Frame> found;
    for (; !out.empty(); out.pop()) {
      if (out.front().id == (node_id << 5 | command)) found.push_back(out.front());
    }
    return found;
  }
  OdriveNode node;
  FrameQueue out;
  AxisRequest request;
  AxisReport axis;
  std::int64_t now_ns = 0;
};

TEST_F(Odrive, ClosedLoopTorqueControl) {
  say(torque(0.5F));
  tick();
  EXPECT_EQ(request.torque_Nm, 0.0);  // not in closed loop: refused
  say(message(0x0B, 1, 1));
  say(message(0x07, 8));
  tick();
  EXPECT_TRUE(request.enable);
  say(torque(-0.75F));
  tick();
  EXPECT_EQ(request.torque_Nm, -0.75);
  say(message(0x0B, 3, 1));  // position control: no torque of its own
  tick();
  EXPECT_EQ(request.torque_Nm, 0.0);
  say(message(0x07, 1));
  tick();
  EXPECT_FALSE(request.enable);
  EXPECT_EQ(node.counters().refused, 1U);
}

TEST_F(Odrive, TellsWhereItIs) {
  axis.encoder_counts = -65536 * 3 - 100;
  axis.velocity_m_per_s = 0.02;
  for (int i = 0; i < 100; ++i) tick();
  const auto estimates = heard(0x09);
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_FLOAT_EQ(load<float>(estimates.back(), 0), -3.0F - 100.0F / 65536.0F);
  EXPECT_FLOAT_EQ(load<float>(estimates.back(), 4), 4.0F);
  Frame ask = message(0x0A);
  ask.remote = true;
  say(ask);
  const auto counts = heard(0x0A);
  ASSERT_EQ(counts.size(), 1U);
  EXPECT_EQ(load<std::int32_t>(counts[0], 0), -65536 * 3 - 100);
  EXPECT_EQ(load<std::int32_t>(counts[0], 4), 65536 - 100);
}

TEST_F(Odrive, HeartbeatTellsStateAndErrors) {
  node.start(0, out);
  for (int i = 0; i < 200; ++i) tick();
  EXPECT_EQ(heard(0x01).size(), 3U);
  say(message(0x02, 0, 0, 0));
  for (int i = 0; i < 100; ++i) tick();
  const auto heartbeat = heard(0x01);
  ASSERT_FALSE(heartbeat.empty());
  EXPECT_EQ(load<std::uint32_t>(heartbeat.back(), 0), 0x4000U);
  EXPECT_EQ(heartbeat.back().data[4], 1);
}

TEST_F(Odrive, WatchdogEmergencyStopAndClear) {
  say(message(0x07, 8));
  say(torque(1.0F));
  tick();
  EXPECT_EQ(request.torque_Nm, 1.0);
  for (int i = 0; i < 99; ++i) tick();
  EXPECT_EQ(node.errors(), 0U);
  tick();
  EXPECT_EQ(node.errors(), 0x800U);
  tick();
  EXPECT_EQ(request.torque_Nm, 0.0);
  EXPECT_FALSE(request.enable);
  say(message(0x07, 8));  // not with an error
  tick();
  EXPECT_FALSE(request.enable);
  say(message(0x18, 0, 0, 0));
  tick();
  EXPECT_TRUE(request.fault_reset);
  say(message(0x07, 8));
  tick();
  EXPECT_TRUE(request.enable);
}

TEST_F(Odrive, RefusesWhatIsNotANumber) {
  say(message(0x07, 8));
  say(torque(0.25F));
  tick();
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    say(torque(bad));
    tick();
    EXPECT_EQ(request.torque_Nm, 0.25);
  }
  Frame cut = torque(1.0F);
  cut.length = 3;
  say(cut);
  tick();
  EXPECT_EQ(request.torque_Nm, 0.25);
  EXPECT_EQ(node.counters().refused, 4U);
}

TEST_F(Odrive, RandomFramesNeverGiveTorqueOutOfClosedLoopOrANonNumber) {
  std::mt19937 random(1);
  for (int i = 0; i < 200000; ++i) {
    Frame frame =
        message(static_cast<int>(random() % 32), static_cast<std::uint32_t>(random() % 4 == 0 ? random() % 16 : random()),
                static_cast<std::uint32_t>(random()), static_cast<int>(random() % 9));
    frame.remote = random() % 10 == 0;
    if (random() % 50 == 0) frame.id = static_cast<std::uint16_t>(random() % 2048);
    say(frame);
    if (random() % 30 == 0) {
      say(message(0x18));
      say(message(0x07, 8));
      say(message(0x0B, 1, 1));
    }
    tick();
    while (!out.empty()) out.pop();
    ASSERT_TRUE(std::isfinite(request.torque_Nm)) << i;
    ASSERT_TRUE(node.closed_loop() || request.torque_Nm == 0.0) << i;
  }
  EXPECT_GT(node.counters().commands, 100U);
}

}  // namespace
}  // namespace feedtwin::io::can
