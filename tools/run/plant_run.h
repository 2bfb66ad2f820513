#pragma once
// A run of the plant from a configuration to its summary: what `serve` and `simulate` share.

#include <atomic>
#include <memory>
#include <vector>

#include "io/faults/fault_port.h"
#include "plant/feed_axis.h"
#include "rt/machine_plant.h"
#include "rt/plant_loop.h"
#include "tools/config/server_config.h"
#include "tools/machine/program_port.h"
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
  [[nodiscard]] rt::SteppedPlant& plant();
  [[nodiscard]] const plant::FeedAxis& axis(std::size_t i) const;
  /// The controller inside the program, if it commands.
  [[nodiscard]] io::Port* inner_controller();
  [[nodiscard]] io::Port& commanding_port();
  struct Reporting {
    std::string name;
    io::Port* port;
  };
  /// Every port that has counters and events.
  [[nodiscard]] std::vector<Reporting> reporting_ports() const;
  [[nodiscard]] MachineFacts machine_facts() const;
  [[nodiscard]] std::vector<io::Counter> machine_counters() const;
  void make_log();
  void make_loop(rt::TickClock& clock);
  void note_port_events();
  void show_progress(std::atomic<bool>& stop, const std::atomic<bool>& ended);

  ServerConfig config_;
  std::vector<plant::FeedAxis> axes_;          ///< of a plant of axes
  std::unique_ptr<rt::MachinePlant> machine_;  ///< or a machine tool
  std::unique_ptr<rt::SteppedPlant> plant_of_axes_;
  std::unique_ptr<LoopbackPort> loopback_;
  std::unique_ptr<ProgramPort> program_;
  std::unique_ptr<io::faults::FaultPort>
      faulty_inner_;  ///< the controller inside, where the configuration has faults for it
  std::unique_ptr<RunLog> log_;
  std::unique_ptr<rt::TickClock> clock_;
  std::unique_ptr<rt::PlantLoop> loop_;
  std::vector<rt::SettingReport> settings_;
  bool timed_ = false;
};

}  // namespace feedtwin::tools
