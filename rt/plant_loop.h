#pragma once
// The loop: wait, receive, guard, step, send, record. tick() is the whole of what happens in real time.

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "io/port.h"
#include "plant/feed_axis.h"
#include "rt/command_guard.h"
#include "rt/event.h"
#include "rt/quick_stop.h"
#include "rt/spsc_ring.h"
#include "rt/stepped_plant.h"
#include "rt/tick_clock.h"
#include "rt/tick_record.h"
#include "rt/tick_stats.h"

namespace feedtwin::rt {

struct LoopSettings {
  double tick_s = 1e-3;
  std::uint64_t ticks = 0;  ///< 0: until stopped
  std::int64_t watchdog_ns = 100'000'000;
  double late_us = 500.0;               ///< a tick that begins later than this is an event
  std::size_t record_capacity = 16384;  ///< rows between the tick and the writer
  bool record_forces = true;            ///< sample the force sensors for the log
  bool record_work = true;              ///< log how long each tick took; false keeps a simulated log repeatable
};

class PlantLoop {
 public:
  /// Set-up. @param commanding the port whose requests act; @param listening further ports, which get the reports only.
  PlantLoop(SteppedPlant& plant, io::Port& commanding, std::vector<io::Port*> listening, TickClock& clock,
            const LoopSettings& settings);
  /// The same for axes that know nothing of each other.
  PlantLoop(std::vector<plant::FeedAxis>& axes, io::Port& commanding, std::vector<io::Port*> listening, TickClock& clock,
            const LoopSettings& settings);

  /// Run until the ticks are done or `stop` is set. Call on the thread that is to be real-time.
  void run(const std::atomic<bool>& stop) noexcept { run_to(settings_.ticks, stop); }
  /// The same up to this many ticks since the start (0: until stopped); may be called again to go on.
  void run_to(std::uint64_t ticks, const std::atomic<bool>& stop) noexcept;

  /// One tick that began at `start`. Wait-free, bounded by the ports' own bounds and the axes' sub-steps.
  void tick(const TickStart& start) noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] SpscRing<AxisRecord>& records() noexcept { return records_; }
  [[nodiscard]] SpscRing<Event>& events() noexcept { return events_; }
  [[nodiscard]] const TickStats& stats() const noexcept { return *stats_; }
  [[nodiscard]] const CommandGuard& guard(std::size_t axis) const noexcept { return guards_[axis]; }
  /// Rises every tick: whoever watches the loop from outside (a watchdog, a progress line) reads it.
  [[nodiscard]] std::uint64_t heartbeat() const noexcept { return heartbeat_.load(std::memory_order_relaxed); }

 private:
  PlantLoop(std::unique_ptr<SteppedPlant> own, SteppedPlant* plant, io::Port& commanding, std::vector<io::Port*> listening,
            TickClock& clock, const LoopSettings& settings);
  /// The axis' torque of this tick, and the row of the log as it stands before the torque acts.
  void command_axis(std::size_t i, bool fresh, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME;
  void report_axis(std::size_t i) noexcept FEEDTWIN_REALTIME;
  /// The request that acts: a spindle does not go on turning when its axes' controller has gone.
  [[nodiscard]] io::MachineRequest machine_in_force() const noexcept FEEDTWIN_REALTIME;
  void note(EventKind kind, std::int32_t axis, double value) noexcept FEEDTWIN_REALTIME;
  void watch_end_stops(std::size_t i) noexcept FEEDTWIN_REALTIME;

  std::unique_ptr<SteppedPlant> own_;
  SteppedPlant& plant_;
  io::Port& commanding_;
  std::vector<io::Port*> listening_;
  TickClock& clock_;
  LoopSettings settings_;
  std::vector<CommandGuard> guards_;
  std::vector<QuickStop> quick_stops_;
  std::vector<io::AxisRequest> requests_;
  io::MachineRequest machine_request_;
  std::vector<double> torques_Nm_;
  std::vector<io::AxisReport> reports_;
  std::vector<AxisRecord> rows_;
  SpscRing<AxisRecord> records_;
  SpscRing<Event> events_;
  std::unique_ptr<TickStats> stats_;
  double lateness_us_ = 0.0, last_work_us_ = 0.0;
  bool started_ = false;
  std::atomic<std::uint64_t> heartbeat_{0};
};

}  // namespace feedtwin::rt
