#include "io/can/twin_bus.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "io/can/frame_bits.h"

namespace feedtwin::io::can {

class TwinBus::Station final : public Link {
 public:
  explicit Station(TwinBus& bus) : bus_(bus) {}

  void open() override {}
  void close() noexcept override {}
  bool receive(ReceivedFrame& frame) noexcept FEEDTWIN_REALTIME override {
    if (inbox_.empty() || inbox_.front().arrival_ns > bus_.now_ns_) return false;
    {
      FEEDTWIN_ADMIT_BEGIN  // a test's bus, not a real one
          frame = inbox_.front();
      inbox_.pop_front();
      FEEDTWIN_ADMIT_END
    }
    return true;
  }
  Sent send(const Frame& frame) noexcept FEEDTWIN_REALTIME override {
    if (bus_.off_) return Sent::lost;
    {
      FEEDTWIN_ADMIT_BEGIN  // as above
          const auto own = std::ranges::count(bus_.waiting_, this, &Waiting::sender);
      if (own >= mailboxes) return Sent::later;
      bus_.waiting_.push_back({frame, this, bus_.now_ns_});
      FEEDTWIN_ADMIT_END
    }
    return Sent::yes;
  }
  [[nodiscard]] std::int64_t now_ns() noexcept FEEDTWIN_REALTIME override { return bus_.now_ns_; }
  bool take_recovery() noexcept FEEDTWIN_REALTIME override { return std::exchange(recovered_, false); }
  bool wait(std::int64_t /*until_ns*/, WakeUp /*by*/) noexcept override { return !inbox_.empty(); }
  void wake() noexcept FEEDTWIN_REALTIME override {}
  void listen(std::span<const std::uint16_t> /*ids*/) noexcept override {}
  void supervise(std::int64_t /*now_ns*/) noexcept override {}
  void add_counters(std::vector<Counter>& /*counters*/) const override {}

  void arrive(const Frame& frame, std::int64_t at_ns) {
    if (!inbox_.empty()) at_ns = std::max(at_ns, inbox_.back().arrival_ns);
    inbox_.push_back({frame, at_ns});
  }
  void recovered() { recovered_ = true; }

 private:
  static constexpr std::ptrdiff_t mailboxes = 256;  // frames that wait for the bus in one station, as a driver's queue
  TwinBus& bus_;
  std::deque<ReceivedFrame> inbox_;
  bool recovered_ = false;
};

std::unique_ptr<Link> TwinBus::connect() {
  auto station = std::make_unique<Station>(*this);
  stations_.push_back(station.get());
  return station;
}

void TwinBus::set_faults(const BusFaults& faults) {
  faults_ = faults;
  random_.seed(faults.seed);
}

void TwinBus::set_off(bool off) {
  if (off) waiting_.clear();
  if (off_ && !off) {
    for (auto* station : stations_) station->recovered();
  }
  off_ = off;
}

void TwinBus::run_to(std::int64_t now_ns) {
  while (!waiting_.empty()) {
    // arbitration at the moment that the bus is free: of the frames waiting by then, the lowest identifier; data before
    // remote
    const auto first = std::ranges::min(waiting_, {}, &Waiting::since_ns).since_ns;
    const std::int64_t start_ns = std::max(free_ns_, first);
    auto next = waiting_.end();
    for (auto w = waiting_.begin(); w != waiting_.end(); ++w) {
      const bool its_first = std::ranges::find(waiting_, w->sender, &Waiting::sender) == w;
      if (w->since_ns > start_ns || !its_first) continue;
      if (next == waiting_.end() ||
          std::pair(w->frame.id, w->frame.remote) < std::pair(next->frame.id, next->frame.remote)) {
        next = w;
      }
    }
    const auto length_ns = static_cast<std::int64_t>(bits_on_the_wire(next->frame) * ns_per_bit_);
    if (start_ns + length_ns > now_ns) break;
    const Waiting sent = *next;
    waiting_.erase(next);
    free_ns_ = start_ns + length_ns;
    busy_ns_ += length_ns;
    deliver(sent, free_ns_);
  }
  now_ns_ = now_ns;
}

void TwinBus::deliver(const Waiting& sent, std::int64_t at_ns) {
  ++frames_;
  trace_.push_back({sent.frame, at_ns});
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  for (auto* station : stations_) {
    if (station == sent.sender) continue;
    if (chance(random_) < faults_.loss) {
      ++lost_;
      continue;
    }
    const auto late_ns = static_cast<std::int64_t>(chance(random_) * static_cast<double>(faults_.delay_ns));
    station->arrive(sent.frame, at_ns + late_ns);
    if (chance(random_) < faults_.duplicate) station->arrive(sent.frame, at_ns + late_ns);
  }
}

}  // namespace feedtwin::io::can
