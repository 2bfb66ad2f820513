// The Modbus port beside a bare libmodbus echo server: exchanges a second, and how long one takes with two in flight.
// Both in one run, in turns, servers on one processor and the client on another (or all on one with --same-cpu).
//
//   build/release/bench_modbus [--same-cpu] [ROUNDS]

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <modbus.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <sched.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "io/descriptor.h"
#include "io/modbus/modbus_port.h"

namespace {

using namespace feedtwin::io;
using Clock = std::chrono::steady_clock;

constexpr int exchanges = 4000, inputs = 12, commands = 4;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void pin(int cpu) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<unsigned>(cpu), &set);
  pthread_setaffinity_np(pthread_self(), sizeof set, &set);
}

struct Free {
  void operator()(modbus_t* context) const {
    modbus_close(context);
    modbus_free(context);
  }
};
using Context = std::unique_ptr<modbus_t, Free>;

int port_of(int socket) {
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  getsockname(socket, reinterpret_cast<sockaddr*>(&bound), &size);
  return ntohs(bound.sin_port);
}

/// libmodbus as its own example uses it: one client, receive and reply.
class EchoServer {
 public:
  EchoServer() : context_(modbus_new_tcp("127.0.0.1", 0)), listener_(modbus_tcp_listen(context_.get(), 4)) {
    port_ = port_of(listener_);
    thread_ = std::thread([this] { run(); });
  }
  ~EchoServer() {
    stop_ = true;
    shutdown(listener_, SHUT_RDWR);
    thread_.join();
    close(listener_);
  }
  int port() const { return port_; }

 private:
  void run() {
    modbus_mapping_t* mapping = modbus_mapping_new(0, 0, 2100, 100);
    while (!stop_) {
      int listener = listener_;
      if (modbus_tcp_accept(context_.get(), &listener) < 0) break;
      std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> request;
      for (;;) {
        const int length = modbus_receive(context_.get(), request.data());
        if (length < 0) break;
        if (length > 0) modbus_reply(context_.get(), request.data(), length, mapping);
      }
      modbus_close(context_.get());
    }
    modbus_mapping_free(mapping);
  }

  Context context_;
  int listener_, port_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// The port under test with the tick at 1 kHz beside it.
class TickingPort {
 public:
  TickingPort() : port_({.port = 0}, {}) {
    port_.open();
    thread_ = std::jthread([this](const std::stop_token& stop) {
      AxisRequest request;
      AxisReport report;
      TickReport tick;
      for (auto next = Clock::now(); !stop.stop_requested(); next += std::chrono::milliseconds(1)) {
        std::this_thread::sleep_until(next);
        port_.receive({&request, 1});
        ++tick.tick;
        ++report.encoder_counts;
        port_.send(tick, {&report, 1});
      }
    });
  }
  ~TickingPort() {
    thread_.request_stop();
    thread_.join();
  }
  int port() const { return port_.tcp_port(); }

 private:
  modbus::ModbusPort port_;
  std::jthread thread_;
};

Context connect_to(int port) {
  Context client(modbus_new_tcp("127.0.0.1", port));
  if (modbus_connect(client.get()) != 0) {
    fmt::print(stderr, "can't connect: {}\n", modbus_strerror(errno));
    std::exit(1);
  }
  return client;
}

void expect(bool good) {
  if (good) return;
  fmt::print(stderr, "exchange failed: {}\n", modbus_strerror(errno));
  std::exit(1);
}

double write_and_read_rate(int port) {
  const Context client = connect_to(port);
  std::array<std::uint16_t, commands> out{};
  std::array<std::uint16_t, inputs> in{};
  const auto begin = Clock::now();
  for (int i = 0; i < exchanges; ++i) {
    out[2] = static_cast<std::uint16_t>(i);
    expect(modbus_write_and_read_registers(client.get(), 0, commands, out.data(), modbus::mirror_begin, inputs, in.data()) ==
           inputs);
  }
  return exchanges / seconds_since(begin);
}

double write_then_read_rate(int port) {
  const Context client = connect_to(port);
  std::array<std::uint16_t, commands> out{};
  std::array<std::uint16_t, inputs> in{};
  const auto begin = Clock::now();
  for (int i = 0; i < exchanges / 2; ++i) {
    out[2] = static_cast<std::uint16_t>(i);
    expect(modbus_write_registers(client.get(), 0, commands, out.data()) == commands);
    expect(modbus_read_input_registers(client.get(), 0, inputs, in.data()) == inputs);
  }
  return exchanges / 2 / seconds_since(begin);
}

/// Two requests always in flight; every exchange's time in ms, sorted.
std::vector<double> pipelined_ms(int port) {
  const Context client = connect_to(port);
  const int socket = modbus_get_socket(client.get());
  fcntl(socket, F_SETFL, 0);  // libmodbus leaves it non-blocking
  const std::array<std::uint8_t, 12> request{0, 0, 0, 0, 0, 6, 1, 4, 0, 0, 0, inputs};
  std::array<Clock::time_point, 2> sent;
  const auto ask = [&](int i) {
    sent[static_cast<std::size_t>(i % 2)] = Clock::now();
    expect(send(socket, request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(request.size()));
  };
  std::vector<double> times;
  ask(0);
  for (int i = 0; i < exchanges; ++i) {
    ask(i + 1);
    std::array<std::uint8_t, 9 + 2 * inputs> reply;
    expect(recv(socket, reply.data(), reply.size(), MSG_WAITALL) == static_cast<ssize_t>(reply.size()));
    times.push_back(1e3 * seconds_since(sent[static_cast<std::size_t>(i % 2)]));
  }
  std::ranges::sort(times);
  return times;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void compare_rates(const char* what, const std::function<double(int)>& rate, int bare, int port, int rounds) {
  std::vector<double> of_bare, of_port, ratio;
  for (int round = 0; round < rounds; ++round) {
    of_bare.push_back(rate(bare));
    of_port.push_back(rate(port));
    ratio.push_back(of_port.back() / of_bare.back());
  }
  fmt::print("{:12} bare {:7.0f}/s   port {:7.0f}/s   ratio {:.2f} ({:.2f} .. {:.2f})\n", what, median(of_bare),
             median(of_port), median(ratio), *std::ranges::min_element(ratio), *std::ranges::max_element(ratio));
}

void print_pipelined(const char* who, int port, int rounds) {
  std::vector<double> p50, p999, longest;
  long stalls = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto ms = pipelined_ms(port);
    p50.push_back(ms[ms.size() / 2]);
    p999.push_back(ms[ms.size() * 999 / 1000]);
    longest.push_back(ms.back());
    stalls += std::ranges::count_if(ms, [](double t) { return t > 5.0; });
  }
  fmt::print(
      "two in flight, {}: p50 {:.3f} ms, p99.9 {:.3f} ms, longest {:.3f} ms (worst round {:.3f}), above 5 ms: {} of {}\n",
      who, median(p50), median(p999), median(longest), *std::ranges::max_element(longest), stalls, exchanges * rounds);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool same = std::ranges::count(arguments, "--same-cpu") > 0;
  int rounds = 9;
  for (const auto& argument : arguments)
    if (argument != "--same-cpu") rounds = std::max(1, std::atoi(argument.c_str()));
  const int cpus = static_cast<int>(std::thread::hardware_concurrency());
  pin(0);
  {
    const EchoServer bare;
    const TickingPort port;
    pin(same || cpus < 2 ? 0 : 1);
    compare_rates("FC23", write_and_read_rate, bare.port(), port.port(), rounds);
    compare_rates("FC16 + FC04", write_then_read_rate, bare.port(), port.port(), rounds);
    print_pipelined("bare", bare.port(), rounds);
    print_pipelined("port", port.port(), rounds);
  }
  return 0;
}
