#pragma once
// A controller that measures: sends a command over UDP at a random phase of the tick and waits for the counts that
// answer it. What it sees is input-to-output latency: the wait for the tick, the tick, and the way through the kernel twice.

#include <atomic>
#include <cstdint>
#include <thread>

#include "rt/latency_histogram.h"
#include "rt/rt_setup.h"

namespace feedtwin::tools {

class UdpProbe {
 public:
  /// Starts asking the plant on this port of the loopback address, at one priority below the tick's.
  UdpProbe(int udp_port, double tick_s, const rt::RtSettings& tick_settings);
  ~UdpProbe();
  UdpProbe(const UdpProbe&) = delete;
  UdpProbe& operator=(const UdpProbe&) = delete;

  /// Ends the measurement. Safe to call twice.
  void stop();
  /// After stop().
  [[nodiscard]] const rt::LatencyHistogram& input_to_output() const noexcept { return histogram_; }
  [[nodiscard]] std::uint64_t unanswered() const noexcept { return unanswered_; }

 private:
  void measure(int socket, double tick_s);

  rt::LatencyHistogram histogram_;
  std::uint64_t unanswered_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace feedtwin::tools
