#include "io/gpio/gpio_port.h"

#include <algorithm>
#include <cmath>

#include "io/gpio/libgpiod_lines.h"
#include "io/monotonic.h"

namespace feedtwin::io::gpio {
namespace {

constexpr std::int64_t longest_sleep_ns = 50'000'000;  // to notice the end

std::int64_t to_ns(double seconds) {
  return std::llround(seconds * 1e9);
}

}  // namespace

GpioPort::GpioPort(std::unique_ptr<Lines> lines, const GpioSettings& settings)
    : settings_(settings),
      lines_(std::move(lines)),
      player_(*lines_, settings.axes, to_ns(settings.tick_s), to_ns(settings.spacing_s)) {
  ::sem_init(&news_, 0, 0);
}

GpioPort::~GpioPort() {
  GpioPort::close();
  ::sem_destroy(&news_);
}

void GpioPort::open() {
  player_.open();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void GpioPort::close() noexcept {
  thread_ = {};
  lines_->close();
}

void GpioPort::send(const TickReport& /*tick*/, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME {
  Aim& aim = aim_.draft();
  aim.given_ns = monotonic_ns();
  for (std::size_t i = 0; i < player_.schedules().size() && i < axes.size(); ++i) aim.counts[i] = axes[i].encoder_counts;
  aim.faults = faults_;
  aim_.post();
  FEEDTWIN_ADMIT_BEGIN  // never blocks: at most wakes the edge thread
      ::sem_post(&news_);
  FEEDTWIN_ADMIT_END
}

bool GpioPort::break_encoder(EncoderFault fault, int axis, bool on, std::int64_t amount) noexcept FEEDTWIN_REALTIME {
  if (axis < 0 || static_cast<std::size_t>(axis) >= player_.schedules().size()) return false;
  faults_[static_cast<std::size_t>(axis)].set(fault, on, amount);
  return true;
}

void GpioPort::take_aim() noexcept {
  if (!aim_.take()) return;
  const Aim& aim = aim_.newest();
  for (std::size_t i = 0; i < player_.schedules().size(); ++i) {
    player_.set_faults(i, aim.faults[i]);
    if (placed_) {
      player_.aim(i, aim.counts[i], aim.given_ns);
    } else {
      player_.place(i, aim.counts[i]);
    }
  }
  placed_ = true;
}

void GpioPort::run(const std::stop_token& stop) noexcept {
  rank_.take(settings_.priority);
  const std::int64_t spin_ns = to_ns(settings_.spin_s);
  while (!stop.stop_requested()) {
    take_aim();
    const std::int64_t now_ns = monotonic_ns();
    const std::int64_t next_ns = std::min(player_.next_ns(), now_ns + longest_sleep_ns);
    if (next_ns <= now_ns) {
      player_.play(now_ns);
      std::uint64_t edges = 0, overspeed = 0;
      std::int64_t behind = 0;
      for (const auto& schedule : player_.schedules()) {
        edges += schedule.edges();
        overspeed += schedule.overspeed_ticks();
        behind = std::max(behind, schedule.most_behind());
      }
      edges_.store(edges, std::memory_order_relaxed);
      overspeed_ticks_.store(overspeed, std::memory_order_relaxed);
      most_behind_.store(behind, std::memory_order_relaxed);
      refused_sets_.store(player_.refused_sets(), std::memory_order_relaxed);
      most_late_ns_.store(player_.most_late_ns(), std::memory_order_relaxed);
    } else if (next_ns - now_ns > spin_ns) {
      const std::int64_t wake_ns = next_ns - spin_ns;
      const timespec wake{static_cast<time_t>(wake_ns / 1'000'000'000), static_cast<long>(wake_ns % 1'000'000'000)};
      (void)::sem_clockwait(&news_, CLOCK_MONOTONIC, &wake);
    }
  }
}

std::vector<Counter> GpioPort::counters() const {
  std::vector<Counter> all;
  all.push_back({"edges", "edges put out", edges_.load(), false});
  all.push_back({"ticks_above_rate",
                 "ticks that asked for more edges than the minimum spacing lets through; made up for later",
                 overspeed_ticks_.load(), true});
  all.push_back({"counts_behind_at_worst", "edges that did not fit into their tick, at worst",
                 static_cast<std::uint64_t>(most_behind_.load()), false});
  all.push_back({"refused_sets", "bulk sets that the kernel refused", refused_sets_.load(), true});
  all.push_back({"edge_late_us_at_worst", "longest that an edge came after its time, us",
                 static_cast<std::uint64_t>(most_late_ns_.load() / 1000), false});
  return all;
}

std::unique_ptr<Port> make_gpio_port(Settings& settings, const PortContext& context) {
  ChipSettings chip;
  chip.chip = settings.text("chip", "/dev/gpiochip0");
  const auto first = static_cast<unsigned>(settings.integer("first_line", 0, 1023, 0));
  if (context.axes > most_axes) settings.fail("first_line", "one chip gives lines for 21 axes at most");
  GpioSettings gpio;
  gpio.tick_s = context.tick_s;
  gpio.spacing_s = settings.number("spacing_us", 2.4, 1e4, 10.0) * 1e-6;
  gpio.spin_s = settings.number("spin_us", 0.0, 1e4, 20.0) * 1e-6;
  gpio.priority = static_cast<int>(settings.integer("priority", 0, 98, 75));
  for (int i = 0; i < context.axes; ++i) {
    const auto& axis = context.axis[static_cast<std::size_t>(i)];
    gpio.axes.push_back({static_cast<std::int64_t>(axis.encoder_counts_per_rev), 0});
    for (unsigned line = 0; line < 3; ++line) chip.offsets.push_back(first + 3 * static_cast<unsigned>(i) + line);
  }
  return std::make_unique<GpioPort>(open_chip(chip), gpio);
}

}  // namespace feedtwin::io::gpio
