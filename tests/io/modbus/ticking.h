#pragma once
// A Modbus port on a free TCP port with a thread in the place of the loop.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "io/modbus/modbus_port.h"
#include "tests/io/modbus/client.h"

namespace feedtwin::io::modbus::test {

/// Times so long that no stall of the host makes a difference, where they are not what is tested.
inline ServerSettings free_port() {
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
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
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

}  // namespace feedtwin::io::modbus::test
