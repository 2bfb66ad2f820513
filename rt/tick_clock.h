#pragma once
// When the next tick begins: on an absolute grid, at a controller's packet, or at once.

#include <atomic>
#include <cstdint>

#include "io/port.h"
#include "plant/realtime.h"

namespace feedtwin::rt {

/// What to do when one or more grid points have passed before a tick could begin. Each one is counted as missed.
enum class Overrun : std::uint8_t {
  skip,      ///< keep phase: leave them out and go on at the next grid point (the plant's time stands still meanwhile)
  catch_up,  ///< run the missed ticks back to back until the grid is met again
  stop,      ///< end the run
};

/// How a tick came to begin.
struct TickStart {
  std::int64_t planned_ns = 0;  ///< CLOCK_MONOTONIC
  std::int64_t woken_ns = 0;
  std::uint64_t missed = 0;  ///< grid points passed over since the last tick
  bool slept = true;         ///< false: the tick before ended too late for a wait; not a wake-up to be measured
  bool proceed = true;       ///< false: the run ends here
};

class TickClock {
 public:
  virtual ~TickClock() = default;
  /// Set-up: the first tick is to begin one period from now. @return now, on this clock's scale
  virtual std::int64_t start() noexcept = 0;
  /// Wait for the next tick. The one place in the loop that may sleep; bounded by the period or the time-out.
  [[nodiscard]] virtual TickStart wait() noexcept = 0;
};

/// Free-running: absolute sleeps (clock_nanosleep, TIMER_ABSTIME) on a grid that never drifts.
class GridClock final : public TickClock {
 public:
  GridClock(std::int64_t period_ns, Overrun overrun) noexcept : period_ns_(period_ns), overrun_(overrun) {}
  std::int64_t start() noexcept override;
  [[nodiscard]] TickStart wait() noexcept override;

 private:
  std::int64_t period_ns_;
  Overrun overrun_;
  std::int64_t next_ns_ = 0;
};

/// Stepped by the commanding port: one tick for each request. Without one for `timeout_ns` it asks `stop` and waits on.
class LockstepClock final : public TickClock {
 public:
  LockstepClock(io::Port& port, std::int64_t timeout_ns, const std::atomic<bool>& stop) noexcept
      : port_(port), timeout_ns_(timeout_ns), stop_(stop) {}
  std::int64_t start() noexcept override;
  [[nodiscard]] TickStart wait() noexcept override;

 private:
  io::Port& port_;
  std::int64_t timeout_ns_;
  const std::atomic<bool>& stop_;
};

/// As fast as possible: simulated time, deterministic. The same grid, never slept on.
class OfflineClock final : public TickClock {
 public:
  explicit OfflineClock(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}
  std::int64_t start() noexcept override { return next_ns_ = 0; }
  [[nodiscard]] TickStart wait() noexcept override;

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace feedtwin::rt
