#pragma once
// The port of the encoder's lines: every tick's counts go to a thread of its own, which spreads the edges over the next
// tick.

#include <semaphore.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "io/gpio/edge_player.h"
#include "io/mailbox.h"
#include "io/real_time_thread.h"
#include "io/registry.h"

namespace feedtwin::io::gpio {

inline constexpr int most_axes = most_lines / 3;

struct GpioSettings {
  double tick_s = 1e-3;
  double spacing_s = 10e-6;  ///< the closest two edges of one axis may come; 1 / spacing is the stated maximum edge rate
  double spin_s = 20e-6;     ///< the edge thread sleeps until this long before an edge, then watches the clock
  int priority = 75;         ///< SCHED_FIFO, below the plant's; 0: none
  std::vector<EdgeAxis> axes;
};

class GpioPort final : public Port {
 public:
  GpioPort(std::unique_ptr<Lines> lines, const GpioSettings& settings);
  ~GpioPort() override;

  [[nodiscard]] std::string_view name() const noexcept override { return "gpio"; }
  void open() override;
  void close() noexcept override;
  std::uint64_t receive(std::span<AxisRequest> /*newest*/) noexcept FEEDTWIN_REALTIME override { return 0; }
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME override;
  bool break_encoder(EncoderFault fault, int axis, bool on, std::int64_t amount) noexcept FEEDTWIN_REALTIME override;
  [[nodiscard]] std::vector<Counter> counters() const override;
  [[nodiscard]] std::vector<PortEvent> take_events() override { return rank_.refusal("edge thread"); }

 private:
  /// What the tick tells the edge thread.
  struct Aim {
    std::int64_t given_ns = 0;
    std::array<std::int64_t, most_axes> counts{};
    std::array<LineFaults, most_axes> faults{};
  };
  void run(const std::stop_token& stop) noexcept;
  void take_aim() noexcept;

  GpioSettings settings_;
  std::unique_ptr<Lines> lines_;
  EdgePlayer player_;
  std::array<LineFaults, most_axes> faults_{};  // the tick's
  Mailbox<Aim> aim_;
  sem_t news_{};
  bool placed_ = false;
  RealTimeRank rank_;
  std::atomic<std::uint64_t> edges_{0}, overspeed_ticks_{0}, refused_sets_{0};
  std::atomic<std::int64_t> most_behind_{0}, most_late_ns_{0};
  std::jthread thread_;
};

/// Kind `gpio`. Keys: chip, first_line, spacing_us, ... as in systemd/examples/gpio.toml.
[[nodiscard]] std::unique_ptr<Port> make_gpio_port(Settings& settings, const PortContext& context);

}  // namespace feedtwin::io::gpio
