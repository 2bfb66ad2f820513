#pragma once
// A count of something that happens on one thread and is read on another.

#include <atomic>
#include <cstdint>

#include "plant/realtime.h"

namespace feedtwin::io {

/// One thread adds, any may read. Wait-free.
class Tally {
 public:
  void operator+=(std::uint64_t more) noexcept FEEDTWIN_REALTIME {
    value_.store(value_.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
  }
  void operator++() noexcept FEEDTWIN_REALTIME { *this += 1; }
  [[nodiscard]] std::uint64_t value() const noexcept FEEDTWIN_REALTIME { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> value_{0};
};

}  // namespace feedtwin::io
