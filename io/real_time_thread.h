#pragma once
// The rank of a port's own thread: below the tick's, above everything ordinary.

#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <cstring>
#include <string>
#include <vector>

#include "io/port.h"

namespace feedtwin::io {

/// Asks for SCHED_FIFO on the calling thread and remembers a refusal until somebody asks for it.
class RealTimeRank {
 public:
  /// On the thread itself. @param priority 0: none is asked for
  void take(int priority) noexcept {
    if (priority == 0) return;
    const sched_param parameter{.sched_priority = priority};
    refusal_.store(::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameter));
  }
  /// From another thread, once: what was refused, if anything.
  [[nodiscard]] std::vector<PortEvent> refusal(const std::string& whose) {
    const int error = refusal_.exchange(0);
    if (error == 0) return {};
    return {{0.0, whose + " without real-time priority: " + std::strerror(error)}};
  }

 private:
  std::atomic<int> refusal_{0};
};

}  // namespace feedtwin::io
