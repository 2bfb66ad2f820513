// The port over real sockets, with clients that do not behave, and what a host can do to it.
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
