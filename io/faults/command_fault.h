#pragma once
// What becomes of one axis's commands on a bad way: lost, late, doubled, corrupted.

#include <array>
#include <bit>
#include <cstdint>

#include "io/port.h"
#include "plant/realtime.h"

namespace feedtwin::io::faults {

/// Which faults act on an axis's commands now; shares 0..1.
struct CommandConditions {
  double lost = 0.0, late = 0.0, repeated = 0.0, corrupted = 0.0;
  std::uint64_t delay_ticks = 0;
};

struct CommandFaultCounters {
  std::uint64_t lost = 0, late = 0, repeated = 0, corrupted = 0;
  std::uint64_t no_room = 0;  ///< late commands lost because too many were under way
};

class CommandFault {
 public:
  explicit CommandFault(std::uint64_t seed) noexcept : random_(seed * 0x9E37'79B9'7F4A'7C15U + 1) {}

  /// Once a tick. @param came a new request came in this tick; @return true if one gets through, then in `through`.
  /// Wait-free.
  bool pass(const AxisRequest& request, bool came, std::uint64_t tick, const CommandConditions& now,
            AxisRequest& through) noexcept FEEDTWIN_REALTIME {
    bool any = false;
    if (came) {
      AxisRequest sent = request;
      if (chance(now.corrupted)) corrupt(sent);
      if (chance(now.lost)) {
        ++counters_.lost;
      } else if (chance(now.late)) {
        delay(sent, tick + now.delay_ticks);
      } else {
        any = true;
        last_ = through = sent;
        known_ = true;
      }
    }
    while (size_ > 0 &&
           waiting_[first_].due_tick <= tick) {  // an older one that comes now overtakes nothing: it is the newest
      last_ = through = waiting_[first_].request;
      known_ = any = true;
      first_ = (first_ + 1) % waiting_.size();
      --size_;
    }
    if (!any && known_ && chance(now.repeated)) {
      through = last_;
      any = true;
      ++counters_.repeated;
    }
    return any;
  }
  [[nodiscard]] const CommandFaultCounters& counters() const noexcept { return counters_; }

 private:
  struct Waiting {
    std::uint64_t due_tick = 0;
    AxisRequest request;
  };
  void delay(const AxisRequest& request, std::uint64_t due_tick) noexcept FEEDTWIN_REALTIME {
    if (size_ == waiting_.size()) {
      ++counters_.no_room;
      return;
    }
    ++counters_.late;
    waiting_[(first_ + size_) % waiting_.size()] = {due_tick, request};
    ++size_;
  }
  /// One bit of the torque, as a single-precision number has it on a wire: from unnoticeable to not a number.
  void corrupt(AxisRequest& request) noexcept FEEDTWIN_REALTIME {
    ++counters_.corrupted;
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(request.torque_Nm)) ^ (1U << (next() % 32U));
    request.torque_Nm = static_cast<double>(std::bit_cast<float>(bits));
  }
  bool chance(double share) noexcept FEEDTWIN_REALTIME {
    return share > 0.0 && static_cast<double>(next() >> 11) * 0x1p-53 < share;
  }
  /// xorshift64* (Vigna 2016)
  std::uint64_t next() noexcept FEEDTWIN_REALTIME {
    random_ ^= random_ >> 12;
    random_ ^= random_ << 25;
    random_ ^= random_ >> 27;
    return random_ * 0x2545'F491'4F6C'DD1DU;
  }

  std::uint64_t random_;
  std::array<Waiting, 1024> waiting_{};
  std::size_t first_ = 0, size_ = 0;
  AxisRequest last_;
  bool known_ = false;
  CommandFaultCounters counters_;
};

}  // namespace feedtwin::io::faults
