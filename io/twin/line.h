#pragma once
// A line that loses, repeats, delays and so reorders what is sent over it: by a seed, the same way every time.

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "plant/realtime.h"

namespace feedtwin::io::twin {

struct LineFaults {
  double loss = 0.0;       ///< probability that a message never arrives
  double duplicate = 0.0;  ///< probability that it arrives twice, each with a delay of its own
  int delay_ticks = 0;     ///< that every message takes
  int jitter_ticks = 0;    ///< up to so many more, evenly spread: later messages may overtake earlier ones
};

/// Holds at most `capacity` messages under way; one more is lost. No allocation after construction as long as copying a
/// message over another does not allocate.
template <class Message>
class Line {
 public:
  Line(const LineFaults& faults, std::uint64_t seed, std::size_t capacity, const Message& prototype)
      : faults_(faults), random_(seed), under_way_(capacity, Slot{prototype, 0, 0, false}) {}

  void send(const Message& message, std::uint64_t now_tick) {
    if (chance() < faults_.loss) {
      ++lost_;
    } else {
      put(message, now_tick);
    }
    if (chance() < faults_.duplicate) {
      ++duplicated_;
      put(message, now_tick);
    }
  }
  /// The next message that has arrived by now; null if there is none. Valid until the next send().
  [[nodiscard]] const Message* receive(std::uint64_t now_tick) {
    Slot* first = nullptr;
    for (Slot& slot : under_way_) {
      if (!slot.used || slot.due_tick > now_tick) continue;
      if (first == nullptr || slot.due_tick < first->due_tick ||
          (slot.due_tick == first->due_tick && slot.order < first->order))
        first = &slot;
    }
    if (first == nullptr) return nullptr;
    first->used = false;
    return &first->message;
  }

  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  [[nodiscard]] std::uint64_t duplicated() const noexcept { return duplicated_; }

 private:
  struct Slot {
    Message message;
    std::uint64_t due_tick, order;
    bool used;
  };

  double chance() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  void put(const Message& message, std::uint64_t now_tick) {
    const auto jitter = static_cast<std::uint64_t>(chance() * (faults_.jitter_ticks + 1));
    for (Slot& slot : under_way_) {
      if (slot.used) continue;
      slot.message = message;
      slot.due_tick = now_tick + static_cast<std::uint64_t>(faults_.delay_ticks) + jitter;
      slot.order = order_++;
      slot.used = true;
      return;
    }
    ++lost_;
  }

  LineFaults faults_;
  std::mt19937_64 random_;
  std::vector<Slot> under_way_;
  std::uint64_t order_ = 0, lost_ = 0, duplicated_ = 0;
};

}  // namespace feedtwin::io::twin
