#pragma once
// A run of the plant from a configuration to its summary: what `serve` and `simulate` share.

#include <atomic>
#include <memory>
#include <vector>

#include "io/faults/fault_port.h"
#include "plant/feed_axis.h"
#include "rt/plant_loop.h"
#include "tools/config/server_config.h"
#include "tools/run/run_log.h"
#include "tools/run/run_summary.h"

namespace feedtwin::tools {

class PlantRun {
 public:
  /// Set-up: axes, ports and log; throws InputError (a port in use, a log folder that can't be written).
  PlantRun(ServerConfig config, std::uint64_t ticks);
  ~PlantRun();
  PlantRun(const PlantRun&) = delete;
  PlantRun& operator=(const PlantRun&) = delete;

  /// On a thread of its own, in real time, until the ticks are done or `stop`; progress on standard error.
  void run_in_real_time(std::atomic<bool>& stop);
  /// On this thread, as fast as possible, deterministic.
  void run_off_line();

  /// After a run. @param verb for the summary's head
  [[nodiscard]] RunSummary summary(const std::string& verb);

 private:
  [[nodiscard]] io::Port& commanding_port();
  /// Every port that has counters and events.
  [[nodiscard]] std::vector<io::Port*> reporting_ports() const;
  void make_log();
  void make_loop(rt::TickClock& clock);
  void note_port_events();
  void show_progress(std::atomic<bool>& stop, const std::atomic<bool>& ended);

  ServerConfig config_;
  std::vector<plant::FeedAxis> axes_;
  std::unique_ptr<LoopbackPort> loopback_;
  std::unique_ptr<io::faults::FaultPort> faulty_loopback_;  ///< where the configuration has faults for it
  std::unique_ptr<RunLog> log_;
  std::unique_ptr<rt::TickClock> clock_;
  std::unique_ptr<rt::PlantLoop> loop_;
  std::vector<rt::SettingReport> settings_;
  bool timed_ = false;
};

}  // namespace feedtwin::tools
