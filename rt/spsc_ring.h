#pragma once
// A wait-free ring between one producer and one consumer (Lamport 1983, with cached indices as in Rigtorp's write-up).
// Full: push() refuses and the caller counts.

#include <atomic>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "plant/realtime.h"

namespace feedtwin::rt {

/// @tparam T trivially copyable. Allocates at construction only; capacity is rounded up to a power of two.
template <class T>
class SpscRing {
 public:
  explicit SpscRing(std::size_t capacity) : slots_(std::bit_ceil(capacity)), mask_(slots_.size() - 1) {}

  [[nodiscard]] std::size_t capacity() const noexcept { return slots_.size(); }

  /// Producer only. All of `items` or none; false when there is no room. Wait-free.
  bool push(std::span<const T> items) noexcept FEEDTWIN_REALTIME {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (slots_.size() - (head - cached_tail_) < items.size()) {
      cached_tail_ = tail_.load(std::memory_order_acquire);
      if (slots_.size() - (head - cached_tail_) < items.size()) return false;
    }
    for (std::size_t i = 0; i < items.size(); ++i) slots_[(head + i) & mask_] = items[i];
    head_.store(head + items.size(), std::memory_order_release);
    return true;
  }
  bool push(const T& item) noexcept FEEDTWIN_REALTIME { return push(std::span<const T>(&item, 1)); }

  /// Consumer only. Fills as much of `items` as there is; returns how many. Wait-free.
  std::size_t pop(std::span<T> items) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t ready = head_.load(std::memory_order_acquire) - tail;
    const std::size_t count = ready < items.size() ? ready : items.size();
    for (std::size_t i = 0; i < count; ++i) items[i] = slots_[(tail + i) & mask_];
    tail_.store(tail + count, std::memory_order_release);
    return count;
  }

 private:
  std::vector<T> slots_;
  std::size_t mask_;
  alignas(64) std::atomic<std::size_t> head_{0};
  std::size_t cached_tail_ = 0;  // the producer's view of tail_
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace feedtwin::rt
