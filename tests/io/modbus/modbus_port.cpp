// The port over real sockets, with clients that behave and clients that do not.
#include "io/modbus/modbus_port.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <list>
#include <random>
#include <string>
#include <thread>

#include "tests/io/modbus/client.h"

namespace feedtwin::io::modbus {
namespace {

using namespace test;
using std::chrono::milliseconds;

/// Times so long that no stall of the host makes a difference, where they are not what is tested.
ServerSettings free_port() {
  ServerSettings settings;
  settings.port = 0;
  settings.request_time_ns = 60'000'000'000;
  settings.command_idle_ns = 60'000'000'000;
  return settings;
}

/// The port with a thread in the place of the loop: an axis whose counts rise by one a tick.
class Ticking {
 public:
  explicit Ticking(int axes = 1, ServerSettings settings = free_port()) : port_(settings, context(axes)) {
    port_.open();
    requests_.resize(static_cast<std::size_t>(axes));
    thread_ = std::jthread([this](const std::stop_token& stop) {
      for (std::uint64_t tick = 0; !stop.stop_requested(); ++tick) {
        step(tick);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
    });
  }
  ~Ticking() {
    thread_.request_stop();
    thread_.join();
  }

  ModbusPort& port() { return port_; }
  int tcp() const { return port_.tcp_port(); }
  std::uint64_t counter(const std::string& name) const {
    for (const Counter& c : port_.counters())
      if (c.name == "modbus_" + name) return c.value;
    ADD_FAILURE() << "no counter " << name;
    return 0;
  }
  /// Torque that the loop has of an axis, in registers' units, once `n` requests or more have come to it.
  long torque(std::size_t axis = 0) const { return torque_[axis].load(); }
  bool enabled(std::size_t axis = 0) const { return enabled_[axis].load(); }
  template <class Condition>
  static bool soon(Condition condition) {
    for (int i = 0; i < 2000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return false;
  }
  std::uint64_t ticks() const { return ticks_.load(); }

 private:
  static PortContext context(int axes) {
    PortContext context;
    context.axes = axes;
    return context;
  }
  void step(std::uint64_t tick) {
    port_.receive(requests_);
    std::vector<AxisReport> reports(requests_.size());
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      torque_[i].store(std::lround(requests_[i].torque_Nm / 1.27 * 1e4));
      enabled_[i].store(requests_[i].enable);
      reports[i].encoder_counts = static_cast<std::int64_t>(tick) - 1000 * static_cast<std::int64_t>(i);
      reports[i].sequence = requests_[i].sequence;
    }
    port_.send({.tick = tick, .missed_ticks = 0, .start_ns = 0}, reports);
    ticks_.store(tick);
  }

  ModbusPort port_;
  std::vector<AxisRequest> requests_;
  std::array<std::atomic<long>, max_axes> torque_{};
  std::array<std::atomic<bool>, max_axes> enabled_{};
  std::atomic<std::uint64_t> ticks_{0};
  std::jthread thread_;
};

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
    EXPECT_EQ(exchange.receive({&request, 1}), 1U);
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
    exchange.receive({&request, 1});
    return request;
  };
  EXPECT_FALSE(write({1}).fault_reset);
  const AxisRequest reset = write({0x81, 1, 1});
  EXPECT_TRUE(reset.fault_reset && reset.enable);
  EXPECT_EQ(reset.superseded, 2U);
  EXPECT_FALSE(write({1}).fault_reset) << "told once";
  EXPECT_TRUE(write({0, 1}).fault_reset) << "enable was taken away and given again";
  EXPECT_FALSE(write({1}).fault_reset);
  EXPECT_EQ(exchange.superseded().value(), 3U);
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

TEST(ModbusPort, MalformedFramesEndTheirConnectionOnly) {
  Ticking loop;
  Client good(loop.tcp());
  for (const Bytes& bad : {Bytes{'G', 'E', 'T', ' ', '/', ' ', 'H', 'T', 'T', 'P'}, Bytes{0, 1, 0, 0, 0, 0, 1, 3},
                           Bytes{0, 1, 0, 0, 0, 1, 1, 3}, Bytes{0, 1, 0, 0, 1, 0, 1, 3}}) {
    Client client(loop.tcp());
    client.send(bad);
    EXPECT_TRUE(client.closed_by_server());
  }
  EXPECT_EQ(loop.counter("malformed_frames"), 4U);
  EXPECT_EQ(registers(good.ask(read(3, 0, 1))).size(), 1U);
}

TEST(ModbusPort, RandomBytesDoNoHarm) {
  Ticking loop;
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    Client client(loop.tcp());
    Bytes bytes(1 + random() % 600);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    if (i % 2 == 0 && bytes.size() > 8) {  // a good header over nonsense
      const Bytes head = frame(Bytes(1 + random() % 250));
      std::copy_n(head.begin(), 7, bytes.begin());
    }
    client.send(bytes);
  }
  Client good(loop.tcp());
  EXPECT_EQ(registers(good.ask(read(3, 0, 1))).size(), 1U);
}

TEST(ModbusPort, SlowLorisIsClosedAndNobodyWaitsForIt) {
  ServerSettings settings = free_port();
  settings.request_time_ns = 150'000'000;
  Ticking loop(1, settings);
  Client slow(loop.tcp()), good(loop.tcp());
  const Bytes request = read(3, 0, 1);
  // a byte at a time of a request that would take many times the time allowed
  for (std::size_t i = 0; i < 5; ++i) {
    slow.send({request[i]});
    EXPECT_EQ(registers(good.ask(read(4, 0, 4))).size(), 4U);
    std::this_thread::sleep_for(milliseconds(60));
  }
  EXPECT_TRUE(slow.closed_by_server());
  EXPECT_EQ(loop.counter("slow_requests"), 1U);
}

TEST(ModbusPort, AClientThatNeverReadsIsClosedWhenTheSocketIsFull) {
  Ticking loop;
  Client deaf(loop.tcp()), good(loop.tcp());
  const Bytes request = read(4, 0, 32);
  Bytes many;
  for (int i = 0; i < 100; ++i) many.insert(many.end(), request.begin(), request.end());
  std::thread flood([&] {
    while (deaf.send(many)) {
    }
  });
  for (int i = 0; i < 200; ++i) EXPECT_EQ(registers(good.ask(read(4, 0, 4))).size(), 4U);
  flood.join();
  EXPECT_TRUE(loop.soon([&] { return loop.counter("unread_replies") == 1U; }));
}

TEST(ModbusPort, OneClientTooManyReplacesTheLongestSilentButNeverTheCommander) {
  ServerSettings settings = free_port();
  settings.max_clients = 4;
  Ticking loop(1, settings);
  Client commander(loop.tcp());
  ASSERT_EQ(exception_of(commander.ask(write_one(0, 5))), 0);
  std::list<Client> others;
  for (int i = 0; i < 200; ++i) {
    others.emplace_back(loop.tcp());
    ASSERT_TRUE(others.back().connected()) << i;
    ASSERT_EQ(registers(others.back().ask(read(3, 0, 1))).size(), 1U) << i;
  }
  EXPECT_EQ(loop.counter("replaced_clients"), 197U);
  EXPECT_EQ(registers(commander.ask(read(3, 0, 1))), std::vector<std::uint16_t>{5});
  EXPECT_TRUE(others.front().closed_by_server());
}

TEST(ModbusPort, ThousandsOfConnectionsThatAreNeverUsed) {
  Ticking loop;
  Client commander(loop.tcp());
  ASSERT_EQ(exception_of(commander.ask(write_one(0, 5))), 0);
  for (int i = 0; i < 3000; ++i) Client{loop.tcp()};  // connect and go
  EXPECT_EQ(registers(commander.ask(read(3, 0, 1))), std::vector<std::uint16_t>{5});
}

TEST(ModbusPort, APortInUseIsSaidInOneLine) {
  Ticking loop;
  ServerSettings settings;
  settings.port = loop.tcp();
  ModbusPort second(settings, {});
  try {
    second.open();
    FAIL() << "opened twice";
  } catch (const PortError& error) {
    EXPECT_EQ(error.what(), "modbus: 127.0.0.1:" + std::to_string(loop.tcp()) + ": already in use by another program");
  }
  settings.address = "192.0.2.1";  // of nobody (RFC 5737)
  EXPECT_THROW(ModbusPort(settings, {}).open(), PortError);
}

TEST(ModbusPort, ClosedTwiceAndOpenedAgainKeepsItsCounters) {
  ModbusPort port(free_port(), {});
  port.open();
  {
    EXPECT_EQ(registers(Client(port.tcp_port()).ask(read(3, 0, 1))).size(), 1U);
  }
  port.close();
  port.close();
  EXPECT_EQ(port.counters().at(0).value, 1U);
  port.open();
  EXPECT_EQ(registers(Client(port.tcp_port()).ask(read(3, 0, 1))).size(), 1U);
}

/// The server's end of a connection, found among this process's own descriptors.
int other_end(int client) {
  sockaddr_in mine{};
  socklen_t size = sizeof mine;
  getsockname(client, reinterpret_cast<sockaddr*>(&mine), &size);
  for (int descriptor = 3; descriptor < 1024; ++descriptor) {
    sockaddr_in peer{};
    size = sizeof peer;
    if (getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) == 0 && peer.sin_port == mine.sin_port)
      return descriptor;
  }
  return -1;
}

TEST(ModbusPort, AcceptedSocketsDoNotWaitForAcknowledgements) {
  Ticking loop;
  Client client(loop.tcp());
  ASSERT_EQ(registers(client.ask(read(4, 0, 1))).size(), 1U);
  const int server_end = other_end(client.socket());
  ASSERT_GE(server_end, 0);
  int on = 0;
  socklen_t size = sizeof on;
  ASSERT_EQ(getsockopt(server_end, IPPROTO_TCP, TCP_NODELAY, &on, &size), 0);
  EXPECT_NE(on, 0) << "libmodbus leaves Nagle's algorithm on";
}

}  // namespace
}  // namespace feedtwin::io::modbus
