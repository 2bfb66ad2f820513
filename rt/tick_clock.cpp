#include "rt/tick_clock.h"

#include <cerrno>
#include <ctime>

#include "io/monotonic.h"

namespace feedtwin::rt {
namespace {

void sleep_until(std::int64_t time_ns) noexcept {
  const timespec until{.tv_sec = static_cast<time_t>(time_ns / io::ns_per_s),
                       .tv_nsec = static_cast<long>(time_ns % io::ns_per_s)};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace

std::int64_t GridClock::start() noexcept {
  const std::int64_t now_ns = io::monotonic_ns();
  next_ns_ = now_ns + period_ns_;
  return now_ns;
}

TickStart GridClock::wait() noexcept {
  TickStart start;
  const std::int64_t before_ns = io::monotonic_ns();
  if (before_ns >= next_ns_ + period_ns_) {  // a whole period late already: at least this grid point is lost
    const auto passed = static_cast<std::uint64_t>((before_ns - next_ns_) / period_ns_);
    if (overrun_ == Overrun::skip) {
      start.missed = passed;
      next_ns_ += static_cast<std::int64_t>(passed) * period_ns_;
    } else {
      start.missed = 1;
      start.proceed = overrun_ != Overrun::stop;
    }
  }
  start.slept = before_ns < next_ns_;
  if (start.slept) sleep_until(next_ns_);
  start.planned_ns = next_ns_;
  start.woken_ns = io::monotonic_ns();
  next_ns_ += period_ns_;
  return start;
}

std::int64_t LockstepClock::start() noexcept {
  return io::monotonic_ns();
}

TickStart LockstepClock::wait() noexcept {
  TickStart start;
  start.planned_ns = io::monotonic_ns();
  while (!port_.wait_for_request(start.planned_ns + timeout_ns_)) {
    if (stop_.load(std::memory_order_relaxed)) {
      start.proceed = false;
      break;
    }
    start.planned_ns = io::monotonic_ns();
  }
  start.woken_ns = io::monotonic_ns();
  start.planned_ns = start.woken_ns;  // the packet sets the time: there is no lateness to speak of
  return start;
}

TickStart OfflineClock::wait() noexcept {
  const std::int64_t now_ns = next_ns_;
  next_ns_ += period_ns_;
  return {.planned_ns = now_ns, .woken_ns = now_ns};
}

}  // namespace feedtwin::rt
