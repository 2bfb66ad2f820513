#pragma once
// The configuration of `serve` and `simulate`. An axis file by itself is one already; more keys stand in tables of their
// own: [server], [loopback], [log], [[port]], [[fault]]. So is a machine file (systemd/examples/machine.toml). See
// systemd/feedtwin.toml for all of them.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/port.h"
#include "io/registry.h"
#include "plant/parameters.h"
#include "rt/plant_loop.h"
#include "rt/rt_setup.h"
#include "rt/tick_clock.h"
#include "tools/config/fault_list.h"
#include "tools/loopback/loopback_port.h"

namespace feedtwin::tools {

struct MachineJob;

/// A port with the name that the configuration gives it, so that two of one kind can be told apart.
struct NamedPort {
  std::string name;
  std::unique_ptr<io::Port> port;
};

/// Who sets the pace.
enum class Pace : std::uint8_t { free_running, lockstep };

struct ServerConfig {
  std::string source = "built in: the source's axis (Table 2)";
  std::vector<plant::AxisParameters> axes;
  std::vector<std::string> axis_sources;
  rt::LoopSettings loop;
  rt::RtSettings real_time;
  rt::Overrun overrun = rt::Overrun::skip;
  Pace pace = Pace::free_running;
  std::int64_t lockstep_timeout_ns = 100'000'000;
  std::shared_ptr<const MachineJob> machine;  ///< where the plant is a machine tool: its axes are then x and y
  std::string controller;                     ///< "loopback", "program" or the name of the commanding port
  std::vector<LoopbackSettings> loopback;     ///< one for each axis
  std::vector<NamedPort> ports;               ///< made, not yet open
  std::vector<ConfiguredFault> faults;        ///< on purpose; worked into `ports` already, the loopback's are not
  std::string log_path;                       ///< empty: no log

  [[nodiscard]] io::PortContext context() const;
};

struct ConfigRequest {
  std::string path;                                      ///< empty: the built-in configuration
  std::optional<std::string> controller = std::nullopt;  ///< overrides the file's
  bool with_ports = true;                                ///< false: off line, no port is made (their keys are still checked)
  bool commanded_inside = false;  ///< the loopback controller commands, or the machine's own, whatever the file says
};

/// Throws InputError.
[[nodiscard]] ServerConfig read_server_config(const ConfigRequest& request);

}  // namespace feedtwin::tools
