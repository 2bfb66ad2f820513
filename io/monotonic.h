#pragma once
// CLOCK_MONOTONIC in ns: the one clock of ticks, arrivals and replies.

#include <cstdint>
#include <ctime>

#include "plant/realtime.h"

namespace feedtwin::io {

inline constexpr std::int64_t ns_per_s = 1'000'000'000;

[[nodiscard]] inline std::int64_t clock_ns(clockid_t clock) noexcept FEEDTWIN_REALTIME {
  timespec now{};
  {
    FEEDTWIN_ADMIT_BEGIN  // read in user space (vDSO): does not enter the kernel
        ::clock_gettime(clock, &now);
    FEEDTWIN_ADMIT_END
  }
  return static_cast<std::int64_t>(now.tv_sec) * ns_per_s + now.tv_nsec;
}
[[nodiscard]] inline std::int64_t monotonic_ns() noexcept FEEDTWIN_REALTIME {
  return clock_ns(CLOCK_MONOTONIC);
}

}  // namespace feedtwin::io
