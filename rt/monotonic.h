#pragma once
// The one clock of the real-time side: CLOCK_MONOTONIC in ns.

#include <cstdint>
#include <ctime>

#include "plant/realtime.h"

namespace feedtwin::rt {

inline constexpr std::int64_t ns_per_s = 1'000'000'000;

[[nodiscard]] inline std::int64_t monotonic_ns() noexcept FEEDTWIN_REALTIME {
  timespec now{};
  {
    FEEDTWIN_ADMIT_BEGIN  // read in user space (vDSO): does not enter the kernel
        ::clock_gettime(CLOCK_MONOTONIC, &now);
    FEEDTWIN_ADMIT_END
  }
  return static_cast<std::int64_t>(now.tv_sec) * ns_per_s + now.tv_nsec;
}

}  // namespace feedtwin::rt
