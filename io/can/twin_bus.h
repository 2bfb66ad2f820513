#pragma once
// A CAN bus inside the process, in its own time: every frame takes the time of its bits, the lowest identifier goes first,
// and frames can be lost, late, doubled, or the bus off. The same seed gives the same run.

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "io/can/link.h"

namespace feedtwin::io::can {

struct BusFaults {
  double loss = 0.0;          ///< share of receptions that are lost
  double duplicate = 0.0;     ///< share of receptions that come twice
  std::int64_t delay_ns = 0;  ///< every reception is late by up to this, evenly spread, order kept
  std::uint64_t seed = 1;
};

class TwinBus {
 public:
  explicit TwinBus(double bits_per_s = 1e6) : ns_per_bit_(1e9 / bits_per_s) {}

  /// A new station. The bus must outlive it; not after the first frame.
  [[nodiscard]] std::unique_ptr<Link> connect();
  void set_faults(const BusFaults& faults);
  /// While off nothing is sent or received; what is queued is gone.
  void set_off(bool off);

  /// Let time pass; frames that have had their bits' time by then have arrived.
  void run_to(std::int64_t now_ns);
  [[nodiscard]] std::int64_t now_ns() const noexcept { return now_ns_; }

  /// How long the bus has been busy, and with what.
  [[nodiscard]] std::int64_t busy_ns() const noexcept { return busy_ns_; }
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  /// Every frame in the order of the wire, with its end; what a bus monitor would have seen.
  [[nodiscard]] const std::vector<ReceivedFrame>& trace() const noexcept { return trace_; }

 private:
  class Station;
  struct Waiting {
    Frame frame;
    Station* sender = nullptr;
    std::int64_t since_ns = 0;
  };
  void deliver(const Waiting& sent, std::int64_t at_ns);

  double ns_per_bit_;
  BusFaults faults_;
  std::mt19937_64 random_{1};  // NOLINT(bugprone-random-generator-seed): faults that repeat
  bool off_ = false;
  std::int64_t now_ns_ = 0, free_ns_ = 0, busy_ns_ = 0;
  std::uint64_t frames_ = 0, lost_ = 0;
  std::vector<Station*> stations_;
  std::vector<Waiting> waiting_;
  std::vector<ReceivedFrame> trace_;
};

}  // namespace feedtwin::io::can
