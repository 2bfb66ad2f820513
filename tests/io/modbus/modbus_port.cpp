// The port over real sockets, with clients that behave.
#include "io/modbus/modbus_port.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <list>
#include <random>
#include <string>
#include <thread>

#include "tests/io/modbus/ticking.h"

namespace feedtwin::io::modbus {
namespace {

using namespace test;
using std::chrono::milliseconds;

TEST(ModbusPort, EveryFunctionInTurn) {
  Ticking loop(2);
  Client client(loop.tcp());
  ASSERT_TRUE(client.connected());
  const auto words = [](std::initializer_list<unsigned> list) {
    return std::vector<std::uint16_t>(list.begin(), list.end());
  };

  const Bytes written = write_many(0, {1234, 1, 7, 50}, 0xABCD);
  EXPECT_EQ(client.ask(written), frame(pdu(16, {0, 4}), 0xABCD));
  EXPECT_TRUE(loop.soon([&] { return loop.torque() == 1234 && loop.enabled(); }));
  EXPECT_EQ(registers(client.ask(read(3, 0, 4))), words({1234, 1, 7, 50}));
  EXPECT_EQ(client.ask(write_one(16, 0xFFFF)), write_one(16, 0xFFFF)) << "an echo";
  EXPECT_TRUE(loop.soon([&] { return loop.torque(1) == -1; }));
  EXPECT_EQ(loop.torque(0), 1234) << "the other axis stays";

  const auto inputs = registers(client.ask(read(4, 0, 64)));
  ASSERT_EQ(inputs.size(), 64U);
  EXPECT_EQ(inputs[0], inputs[3]);
  EXPECT_EQ(inputs[1] + 65536.0 * inputs[2] - 2147483648.0, inputs[8]) << "counts follow the tick here";
  EXPECT_EQ(static_cast<std::int32_t>(inputs[32 + 12] * 65536U + inputs[32 + 13]), inputs[8] - 1000);
  EXPECT_EQ(inputs[4], 0x0040 | 1 << 9) << "disabled, somebody in command";

  const auto both = registers(client.ask(write_and_read(0, {4321}, 2000, 12)));
  ASSERT_EQ(both.size(), 12U);
  EXPECT_EQ(both[1] + 65536.0 * both[2] - 2147483648.0, both[8]);
  EXPECT_TRUE(loop.soon([&] { return loop.torque() == 4321; }));
  EXPECT_EQ(registers(client.ask(write_and_read(0, {9, 8}, 0, 2))), words({9, 8})) << "written before it is read";
}

TEST(ModbusPort, AnalogAliasAndClipping) {
  Ticking loop;
  Client client(loop.tcp());
  client.ask(write_one(4, 0x8001));  // -10 V
  EXPECT_TRUE(loop.soon([&] { return loop.torque() == -10000; }));
  EXPECT_EQ(loop.counter("clipped_torques"), 0U);
  client.ask(write_one(0, 20000));
  EXPECT_TRUE(loop.soon([&] { return loop.torque() == 10000; }));
  EXPECT_EQ(loop.counter("clipped_torques"), 1U);
  EXPECT_TRUE(loop.soon([&] { return (registers(client.ask(read(4, 4, 1))).at(0) & 1 << 11) != 0; }));
}

TEST(ModbusPort, SequenceGoesOnBeyondSixteenBitsAndAFreshStartIsAFarJump) {
  PortContext context;
  Exchange exchange(context);
  RegisterBank bank(exchange);
  const auto written = [&](std::uint16_t sequence) {
    const Bytes bytes = write_one(2, sequence);
    bank.write(check(bytes, bank.extent()), 0);
    AxisRequest request;
    EXPECT_EQ(exchange.requests().receive({&request, 1}), 1U);
    return request.sequence;
  };
  std::uint32_t last = written(1);
  for (unsigned n = 2; n < 200'000; ++n) {
    const std::uint32_t now = written(static_cast<std::uint16_t>(n));
    ASSERT_EQ(now, last + 1) << n;
    last = now;
  }
  const std::uint32_t restarted = written(static_cast<std::uint16_t>(last - 5));
  EXPECT_GT(restarted - last, 1000U);
  EXPECT_LT(restarted - last, 0x8000'0000U);
  bank.forget_commands();
  const std::uint32_t other = written(1);
  EXPECT_GT(other - restarted, 1000U);
  EXPECT_EQ(other & 0xFFFF, 1U);
}

TEST(ModbusPort, AChangeBetweenTwoTicksIsNotLost) {
  Exchange exchange({});
  RegisterBank bank(exchange);
  const auto write = [&](std::initializer_list<std::uint16_t> control) {
    for (const auto bits : control) {
      const Bytes bytes = write_one(1, bits);
      bank.write(check(bytes, bank.extent()), 0);
    }
    AxisRequest request;
    exchange.requests().receive({&request, 1});
    return request;
  };
  EXPECT_FALSE(write({1}).fault_reset);
  const AxisRequest reset = write({0x81, 1, 1});
  EXPECT_TRUE(reset.fault_reset && reset.enable);
  EXPECT_EQ(reset.superseded, 2U);
  EXPECT_FALSE(write({1}).fault_reset) << "told once";
  EXPECT_TRUE(write({0, 1}).fault_reset) << "enable was taken away and given again";
  EXPECT_FALSE(write({1}).fault_reset);
  EXPECT_EQ(exchange.requests().superseded().value(), 3U);
}

TEST(ModbusPort, TheReadBlockIsAlwaysOfOneTick) {
  Ticking loop(4);
  ASSERT_TRUE(loop.soon([&] { return loop.ticks() > 0; }));
  Client client(loop.tcp());
  for (int i = 0; i < 3000; ++i) {
    const auto r = registers(client.ask(read(4, 0, 125)));
    ASSERT_EQ(r.size(), 125U);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(r[axis * 32], r[0]);
      ASSERT_EQ(r[axis * 32 + 3], r[0]);
      const double counts = r[axis * 32 + 1] + 65536.0 * r[axis * 32 + 2] - 2147483648.0;
      ASSERT_EQ(counts, r[8] + 65536.0 * r[9] - 1000.0 * static_cast<double>(axis));
    }
  }
}

TEST(ModbusPort, RequestsInFlightAreAllAnsweredInOrderWhateverTheSplit) {
  Ticking loop;
  Client client(loop.tcp());
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    Bytes stream;
    const auto count = static_cast<unsigned>(1 + random() % 60);  // also more than the server's buffer holds
    for (unsigned n = 0; n < count; ++n) {
      const Bytes one = n % 3 == 0 ? write_many(0, {1, 2, 3, 4}, n) : n % 3 == 1 ? read(4, 0, 12, n) : read(99, 0, 1, n);
      stream.insert(stream.end(), one.begin(), one.end());
    }
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t piece = std::min<std::size_t>(1 + random() % 700, stream.size() - at);
      ASSERT_TRUE(client.send(Bytes(stream.begin() + static_cast<std::ptrdiff_t>(at),
                                    stream.begin() + static_cast<std::ptrdiff_t>(at + piece))));
      at += piece;
    }
    for (unsigned n = 0; n < count; ++n) {
      const Bytes reply = client.receive();
      ASSERT_GE(reply.size(), 9U) << "round " << round << " request " << n;
      ASSERT_EQ(reply[0] << 8 | reply[1], static_cast<int>(n));
      ASSERT_EQ(exception_of(reply), n % 3 == 2 ? 1 : 0);
    }
  }
}

TEST(ModbusPort, OneIsInCommandTheOthersReadAndAreRefused) {
  Ticking loop;
  Client first(loop.tcp()), second(loop.tcp());
  EXPECT_EQ(exception_of(first.ask(write_one(0, 100))), 0);
  EXPECT_EQ(exception_of(second.ask(write_one(0, 200))), 6);
  EXPECT_EQ(exception_of(second.ask(write_many(0, {200}))), 6);
  EXPECT_EQ(exception_of(second.ask(write_and_read(0, {200}, 0, 1))), 6);
  EXPECT_EQ(registers(second.ask(read(3, 0, 1))), std::vector<std::uint16_t>{100});
  EXPECT_EQ(loop.counter("refused_writes"), 3U);
  EXPECT_TRUE(loop.soon([&] { return loop.torque() == 100; }));
}

TEST(ModbusPort, WhoGoesReleasesTheCommandAndTheNextStartsFromZero) {
  Ticking loop;
  Client first(loop.tcp()), second(loop.tcp());
  first.ask(write_many(0, {100, 1, 55, 20}));
  first.close();
  ASSERT_TRUE(loop.soon([&] { return exception_of(second.ask(write_one(0, 200))) == 0; }));
  EXPECT_EQ(registers(second.ask(read(3, 0, 4))), (std::vector<std::uint16_t>{200, 0, 0, 0}));
  EXPECT_TRUE(loop.soon([&] { return loop.torque() == 200 && !loop.enabled(); }));
}

TEST(ModbusPort, ASilentCommanderLosesCommandToTheOneWhoWrites) {
  ServerSettings settings = free_port();
  settings.command_idle_ns = 200'000'000;
  Ticking loop(1, settings);
  Client first(loop.tcp()), second(loop.tcp());
  first.ask(write_one(0, 100));
  ASSERT_TRUE(loop.soon([&] { return exception_of(second.ask(write_one(0, 200))) == 0; }));
  EXPECT_TRUE(loop.soon([&] { return loop.torque() == 200; }));
  EXPECT_EQ(loop.counter("command_changes"), 2U);
}

TEST(ModbusPort, TwoWhoFightLeaveOneInCommandAndEveryTorqueFromHim) {
  Ticking loop;
  std::atomic<bool> stop{false};
  std::atomic<int> refused{0}, accepted{0};
  const auto fight = [&](std::uint16_t torque) {
    Client client(loop.tcp());
    while (!stop) (exception_of(client.ask(write_many(0, {torque, 1}))) == 6 ? refused : accepted)++;
  };
  std::thread a(fight, std::uint16_t{111}), b(fight, std::uint16_t{222});
  ASSERT_TRUE(loop.soon([&] { return refused > 200 && accepted > 200 && loop.torque() != 0; }));
  const long torque = loop.torque();
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(loop.torque(), torque);
  EXPECT_EQ(loop.counter("command_changes"), 1U);
  stop = true;
  a.join();
  b.join();
}

TEST(ModbusPort, BeforeTheFirstTickThePositionIsZero) {
  ModbusPort port(free_port(), {});
  port.open();
  Client client(port.tcp_port());
  EXPECT_EQ(registers(client.ask(read(4, 0, 8))), (std::vector<std::uint16_t>{0, 0, 0x8000, 0, 0x40, 0, 0, 65535}));
}

TEST(ModbusPort, APortThatIsOnlyWatchedRefusesWrites) {
  ModbusPort port(free_port(), {});
  port.open();
  Client client(port.tcp_port());
  EXPECT_EQ(exception_of(client.ask(write_one(0, 1))), 0) << "the loop has not begun";
  const AxisReport report;
  for (std::uint64_t tick = 0; tick < 3; ++tick) port.send({.tick = tick, .missed_ticks = 0, .start_ns = 0}, {&report, 1});
  EXPECT_EQ(exception_of(client.ask(write_one(0, 1))), 6);
  EXPECT_EQ(registers(client.ask(read(4, 8, 1))), std::vector<std::uint16_t>{2});
}

}  // namespace
}  // namespace feedtwin::io::modbus
