// The port with a thread of its own: SYNC is answered without a tick, and what passes between the threads is whole.

#include "io/can/can_port.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>

#include "io/can/canopen_node.h"
#include "io/monotonic.h"
#include "tests/io/can/bus_master.h"

namespace feedtwin::io::can {
namespace {

/// A bus of two stations in one process: the port's end is this link, the master's end say() and hear().
class PairedLink final : public Link {
 public:
  void open() override {}
  void close() noexcept override {}
  bool receive(ReceivedFrame& frame) noexcept FEEDTWIN_REALTIME override {
    FEEDTWIN_ADMIT_BEGIN  // a test's bus, not a real one
        const std::lock_guard lock(mutex_);
    if (to_port_.empty()) return false;
    frame = to_port_.front();
    to_port_.pop_front();
    FEEDTWIN_ADMIT_END
    return true;
  }
  Sent send(const Frame& frame) noexcept FEEDTWIN_REALTIME override {
    FEEDTWIN_ADMIT_BEGIN  // as above
        const std::lock_guard lock(mutex_);
    to_master_.push_back(frame);
    changed_.notify_all();
    FEEDTWIN_ADMIT_END
    return Sent::yes;
  }
  [[nodiscard]] std::int64_t now_ns() noexcept FEEDTWIN_REALTIME override { return monotonic_ns(); }
  bool take_recovery() noexcept FEEDTWIN_REALTIME override { return false; }
  bool wait(std::int64_t until_ns, WakeUp by) noexcept override {
    std::unique_lock lock(mutex_);
    const std::chrono::steady_clock::time_point until{std::chrono::nanoseconds(until_ns)};
    const bool called =
        changed_.wait_until(lock, until, [&] { return called_ || (by == WakeUp::frame && !to_port_.empty()); });
    called_ = false;
    return called;
  }
  void wake() noexcept FEEDTWIN_REALTIME override {
    FEEDTWIN_ADMIT_BEGIN  // as above
        const std::lock_guard lock(mutex_);
    called_ = true;
    changed_.notify_all();
    FEEDTWIN_ADMIT_END
  }
  void listen(std::span<const std::uint16_t> /*ids*/) noexcept override {}
  void supervise(std::int64_t /*now_ns*/) noexcept override {}
  void add_counters(std::vector<Counter>& /*counters*/) const override {}

  void say(const Frame& frame) {
    const std::lock_guard lock(mutex_);
    to_port_.push_back({frame, monotonic_ns()});
    changed_.notify_all();
  }
  /// The next frame with this identifier; an empty one, of identifier 0, after 5 s.
  Frame hear(int id) {
    std::unique_lock lock(mutex_);
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (true) {
      while (!to_master_.empty()) {
        const Frame frame = to_master_.front();
        to_master_.pop_front();
        if (frame.id == id) return frame;
      }
      if (changed_.wait_until(lock, until) == std::cv_status::timeout) return {};
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ReceivedFrame> to_port_;
  std::deque<Frame> to_master_;
  bool called_ = false;
};

struct Bench {
  Bench() {
    auto own = std::make_unique<PairedLink>();
    link = own.get();
    std::vector<std::unique_ptr<Device>> devices;
    devices.push_back(std::make_unique<CanopenNode>(DriveIdentity{}));
    port = std::make_unique<CanPort>(std::move(own), std::move(devices),
                                     CanPortSettings{.answers_at_once = true, .priority = 0});
    report.encoder_counts = -77;
    port->open();
    port->send({}, {&report, 1});
    EXPECT_EQ(link->hear(0x701), make_frame(0x701, {0}));
    link->say(make_frame(0x601, {0x2B, 0x02, 0x20, 0, 0, 0, 0, 0}));  // no SYNC timeout: this host may be busy
    EXPECT_EQ(link->hear(0x581).data[0], 0x60);
  }
  /// One tick of the plant: takes what there is, gives the next count.
  std::uint64_t tick() {
    const auto fresh = port->receive({&request, 1});
    ++report.ticks_done;
    ++report.encoder_counts;
    report.sequence = request.sequence;
    port->send({}, {&report, 1});
    return fresh;
  }
  Frame exchange(int controlword, int per_mille) {
    link->say(make_frame(0x201, {controlword, 0, per_mille & 0xFF, per_mille >> 8 & 0xFF, 10}));
    link->say(make_frame(0x80, {}));
    return link->hear(0x181);
  }
  void enable() {
    link->say(make_frame(0, {1, 1}));
    for (const int word : {0x06, 0x07, 0x0F}) exchange(word, 0);
  }
  PairedLink* link = nullptr;
  std::unique_ptr<CanPort> port;
  AxisReport report;
  AxisRequest request;
};

TEST(CanPort, ASyncIsAnsweredWithoutATick) {
  Bench b;
  b.enable();
  const Frame tpdo = b.exchange(0x0F, 250);
  ASSERT_EQ(tpdo.id, 0x181);
  EXPECT_EQ(load<std::uint16_t>(tpdo, 0) & 0x6F, 0x27);
  EXPECT_EQ(load<std::int32_t>(tpdo, 2), -77);
  EXPECT_EQ(b.request.torque_Nm, 0.0) << "before the tick";
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (b.request.torque_Nm == 0.0 && std::chrono::steady_clock::now() < until) {
    b.tick();  // the answer leaves before the request is handed over
    std::this_thread::yield();
  }
  EXPECT_DOUBLE_EQ(b.request.torque_Nm, 0.25 * 1.27);
  EXPECT_TRUE(b.request.enable);
  EXPECT_GE(b.request.reply_ns, 0);
  EXPECT_FALSE(b.port->can_step_the_plant());
}

TEST(CanPort, TheAnswerNamesItsTick) {
  Bench b;
  // TPDO 3: the tick and the position, at every SYNC
  for (const auto& [index, sub, value, code] :
       std::initializer_list<std::array<std::uint32_t, 4>>{{0x1A02, 1, 0x2004'0020, 0x23},
                                                           {0x1A02, 2, 0x6064'0020, 0x23},
                                                           {0x1A02, 0, 2, 0x2F},
                                                           {0x1802, 1, 0x4000'0381, 0x23}}) {
    Frame request = make_frame(0x601, {static_cast<int>(code), static_cast<int>(index & 0xFF), static_cast<int>(index >> 8),
                                       static_cast<int>(sub), 0, 0, 0, 0});
    store(request, 4, value);
    b.link->say(request);
    ASSERT_EQ(b.link->hear(0x581).data[0], 0x60) << std::hex << index;
  }
  b.link->say(make_frame(0, {1, 1}));
  std::uint32_t last = 0;
  std::jthread ticking([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      b.tick();
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  });
  for (int i = 0; i < 300; ++i) {
    b.link->say(make_frame(0x80, {}));
    const Frame tpdo = b.link->hear(0x381);
    ASSERT_EQ(tpdo.id, 0x381);
    const auto ticks = load<std::uint32_t>(tpdo, 0);
    ASSERT_EQ(load<std::int32_t>(tpdo, 4), static_cast<std::int32_t>(ticks) - 77);
    ASSERT_GE(ticks, last);
    last = ticks;
  }
  EXPECT_GT(last, 0U);
}

TEST(CanPort, AFloodIsTakenInPiecesOfATick) {
  Bench b;
  constexpr int frames = 1000;
  for (int i = 0; i < frames; ++i) b.link->say(make_frame(0x123, {i & 0xFF}));
  Frame read = make_frame(0x601, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  b.link->say(read);
  int ticks = 0;
  std::jthread listening([&] { EXPECT_EQ(b.link->hear(0x581).id, 0x581); });
  for (; ticks < frames / BusNodes::most_frames; ++ticks) {
    b.tick();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  listening.join();
  b.port->close();
  EXPECT_EQ(b.port->totals().received, frames + 2U);  // and the two requests by SDO
  EXPECT_GE(b.port->totals().left_for_next_tick, 1U);
}

TEST(CanPort, WhatAnotherPortCommandsIsNotDisturbedAndCounted) {
  Bench b;
  for (int i = 0; i < 3; ++i) b.port->send({}, {&b.report, 1});  // nobody asks this port
  b.enable();
  b.exchange(0x0F, 100);
  b.port->close();
  EXPECT_GT(b.port->not_in_command(), 0U);
}

TEST(CanPort, ADeadLineIsSaidByTheDrive) {
  Bench b;
  b.enable();
  b.tick();
  b.port->break_encoder(EncoderFault::dead_a, 0, true, 0);
  b.tick();
  EXPECT_EQ(load<std::uint16_t>(b.link->hear(0x81), 0), 0x7305);
}

}  // namespace
}  // namespace feedtwin::io::can
