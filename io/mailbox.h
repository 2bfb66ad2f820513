#pragma once
// The newest value from one writer to one reader, on different threads: a triple buffer.
// One slot belongs to the writer, one to the reader, and the third is exchanged between them. Both sides are wait-free
// (one atomic exchange, no retry), so that neither a writer preempted half-way nor a busy reader can hold up the tick; a
// value is never torn, and one that is overwritten before it was taken is gone (a seqlock's reader would have to try again).
// After: Simpson, "Four-slot fully asynchronous communication mechanism", IEE Proc. 137 Pt E (1990), 17-30.

#include <array>
#include <atomic>
#include <cstdint>

#include "plant/realtime.h"

namespace feedtwin::io {

template <class Value>
class Mailbox {
 public:
  /// Writer: the slot to fill in; its content is that of some earlier value. Publish it with post().
  [[nodiscard]] Value& draft() noexcept FEEDTWIN_REALTIME { return slots_[writer_slot_].value; }
  void post() noexcept FEEDTWIN_REALTIME {
    writer_slot_ = shared_.exchange(static_cast<std::uint8_t>(writer_slot_ | unread), std::memory_order_acq_rel) & slot_mask;
  }

  /// Writer: the value last posted has not been taken yet. It may be taken at any moment.
  [[nodiscard]] bool waiting() const noexcept FEEDTWIN_REALTIME {
    return (shared_.load(std::memory_order_relaxed) & unread) != 0;
  }

  /// Reader: make newest() the last value posted. @return false if none was posted since the last call.
  bool take() noexcept FEEDTWIN_REALTIME {
    if ((shared_.load(std::memory_order_relaxed) & unread) == 0) return false;
    reader_slot_ = shared_.exchange(reader_slot_, std::memory_order_acq_rel) & slot_mask;
    return true;
  }
  /// Reader: the value last taken, its own until the next take().
  [[nodiscard]] const Value& newest() const noexcept FEEDTWIN_REALTIME { return slots_[reader_slot_].value; }

 private:
  static constexpr std::uint8_t slot_mask = 3, unread = 4;
  struct alignas(64) Slot {
    Value value{};
  };
  std::array<Slot, 3> slots_;
  alignas(64) std::uint8_t writer_slot_ = 0;
  alignas(64) std::atomic<std::uint8_t> shared_{1};
  alignas(64) std::uint8_t reader_slot_ = 2;
};

}  // namespace feedtwin::io
