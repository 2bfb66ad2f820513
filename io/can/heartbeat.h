#pragma once
// Heartbeats both ways, CiA 301: the node's own every 1017 ms, and supervision of the master's by 1016.

#include <cstdint>

#include "plant/realtime.h"

namespace feedtwin::io::can {

class HeartbeatProducer {
 public:
  /// @return true when one is due. period_ms 0: never. Wait-free.
  bool due(std::int64_t now_ns, std::int64_t period_ms) noexcept FEEDTWIN_REALTIME {
    if (period_ms <= 0 || now_ns < next_ns_) return false;
    // on the grid of its own; after a pause it starts afresh instead of catching up
    next_ns_ = now_ns - next_ns_ < period_ms * 1'000'000 ? next_ns_ + period_ms * 1'000'000 : now_ns + period_ms * 1'000'000;
    return true;
  }
  /// @param next_ns when the next one is due; 0: at once
  void restart(std::int64_t next_ns = 0) noexcept FEEDTWIN_REALTIME { next_ns_ = next_ns; }

 private:
  std::int64_t next_ns_ = 0;
};

class HeartbeatConsumer {
 public:
  /// Armed by the first heartbeat that is seen.
  void seen(std::int64_t now_ns) noexcept FEEDTWIN_REALTIME {
    armed_ = true;
    last_ns_ = now_ns;
  }
  void disarm() noexcept FEEDTWIN_REALTIME { armed_ = false; }
  /// @return true once when a heartbeat is overdue. period_ms 0: never. Wait-free.
  bool lost(std::int64_t now_ns, std::int64_t period_ms) noexcept FEEDTWIN_REALTIME {
    if (!armed_ || period_ms <= 0 || now_ns - last_ns_ <= period_ms * 1'000'000) return false;
    armed_ = false;  // until the next one comes
    return true;
  }

 private:
  bool armed_ = false;
  std::int64_t last_ns_ = 0;
};

}  // namespace feedtwin::io::can
