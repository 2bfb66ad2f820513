#pragma once
// Requests from a port's own thread to the tick: the newest of each axis and of the machine, wait-free on both sides.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "io/mailbox.h"
#include "io/port.h"
#include "io/tally.h"

namespace feedtwin::io {

class RequestExchange {
 public:
  // the port's thread

  /// The newest request of an axis; what acts by a change alone is kept of one that no tick has seen. Then hand_over().
  void put(std::size_t axis, const AxisRequest& request) noexcept FEEDTWIN_REALTIME {
    // should it be taken after all in this moment, the change is told twice, which is once
    image_.request[axis] = requests_.waiting() ? replacing(image_.request[axis], request) : request;
    ++image_.number[axis];
  }
  void put(const MachineRequest& request) noexcept FEEDTWIN_REALTIME {
    image_.machine = request;
    ++image_.machine_number;
  }
  void hand_over() noexcept FEEDTWIN_REALTIME {
    requests_.draft() = image_;
    requests_.post();
  }
  /// The loop gives out its results here but takes its commands from another port.
  [[nodiscard]] bool only_watched() const noexcept FEEDTWIN_REALTIME {
    return sends_.load(std::memory_order_relaxed) > 1 && !asked_.load(std::memory_order_relaxed);
  }

  // the tick

  /// @return a bit for each axis that has a new request
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME {
    asked_.store(true, std::memory_order_relaxed);
    if (!requests_.take()) return 0;
    const Image& image = requests_.newest();
    std::uint64_t fresh = 0;
    for (std::size_t axis = 0; axis < std::min(newest.size(), number_seen_.size()); ++axis) {
      if (image.number[axis] == number_seen_[axis]) continue;
      newest[axis] = image.request[axis];
      newest[axis].superseded = static_cast<std::uint32_t>(image.number[axis] - number_seen_[axis] - 1);
      superseded_ += newest[axis].superseded;
      number_seen_[axis] = image.number[axis];
      fresh |= std::uint64_t{1} << axis;
    }
    return fresh;
  }
  /// After receive(), of the same image.
  bool receive_machine(MachineRequest& newest) noexcept FEEDTWIN_REALTIME {
    const Image& image = requests_.newest();
    if (image.machine_number == machine_number_seen_) return false;
    machine_number_seen_ = image.machine_number;
    newest = image.machine;
    return true;
  }
  /// The tick has given out its results.
  void sent() noexcept FEEDTWIN_REALTIME {  // the first time is before the first tick
    sends_.store(sends_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  /// Requests that a newer one replaced before a tick came. From any thread.
  [[nodiscard]] const Tally& superseded() const noexcept { return superseded_; }

 private:
  /// Every axis's newest request, and its number, so that the tick sees which ones are new.
  struct Image {
    std::array<AxisRequest, max_axes> request{};
    std::array<std::uint64_t, max_axes> number{};
    MachineRequest machine{};
    std::uint64_t machine_number = 0;
  };

  Image image_;  // the port's thread's
  std::array<std::uint64_t, max_axes> number_seen_{};
  std::uint64_t machine_number_seen_ = 0;
  Tally superseded_;
  std::atomic<bool> asked_{false};
  std::atomic<std::uint64_t> sends_{0};
  Mailbox<Image> requests_;
};

}  // namespace feedtwin::io
