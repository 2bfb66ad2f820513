#include "tools/config/server_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "io/faults/fault_port.h"
#include "plant/parameter_table.h"
#include "tools/config/axis_file.h"
#include "tools/config/input_error.h"
#include "tools/config/toml_settings.h"
#include "tools/loopback/recorded_path.h"
#include "tools/loopback/tracking_gains.h"
#include "tools/machine/job_keys.h"
#include "tools/recording/csv.h"

namespace feedtwin::tools {
namespace {

void read_axes(TomlFile& file, ServerConfig& config) {
  const auto paths = file.texts("server.axes");
  if (!paths.empty() && file.has("motor")) file.fail("server.axes", "names axis files, but this file holds an axis itself");
  for (const auto& path : paths) {
    const auto beside = std::filesystem::path(file.path()).parent_path() / path;
    config.axes.push_back(read_axis_file(beside.string()));
    config.axis_sources.push_back(beside.string());
  }
  if (paths.empty() && (file.has("motor") || file.has("axis"))) {
    config.axes.push_back(axis_from(file));
    config.axis_sources.push_back(file.path());
  }
  if (config.axes.size() > io::max_axes) file.fail("server.axes", fmt::format("at most {} axes", io::max_axes));
}

void read_server(TomlFile& file, ServerConfig& config) {
  config.loop.tick_s = file.number("server.period_s", 1e-5, 0.1, 1e-3);
  config.loop.watchdog_ns = static_cast<std::int64_t>(file.number("server.watchdog_s", 1e-3, 60.0, 0.1) * 1e9);
  config.loop.late_us = file.number("server.late_us", 1.0, 1e6, 500.0);
  const auto overrun = file.word("server.overrun", {"skip", "catch-up", "stop"}, "skip");
  config.overrun = overrun == "skip" ? rt::Overrun::skip : overrun == "catch-up" ? rt::Overrun::catch_up : rt::Overrun::stop;
  config.pace = file.word("server.pace", {"free-running", "lockstep"}, "free-running") == "lockstep" ? Pace::lockstep
                                                                                                     : Pace::free_running;
  config.lockstep_timeout_ns = static_cast<std::int64_t>(file.number("server.lockstep_timeout_s", 1e-3, 60.0, 0.1) * 1e9);
  config.controller = file.text("server.controller", "");

  auto& host = config.real_time;
  host.real_time = file.boolean("server.real_time", true);
  host.priority = static_cast<int>(file.integer("server.priority", 0, 98, 80));
  host.cpu = static_cast<int>(file.integer("server.cpu", -1, 4095, -1));
  host.lock_memory = file.boolean("server.lock_memory", true);
  host.hold_cpu_latency = file.boolean("server.hold_cpu_latency", true);

  config.log_path = file.text("log.file", "");
  config.loop.record_forces = file.boolean("log.forces", true);
}

double mean(const plant::Directional& value) {
  return 0.5 * (value.pos + value.neg);
}

double coulomb_N(const plant::AxisParameters& axis) {
  return mean(axis.motor.coulomb_N) + mean(axis.ball_screw.coulomb_N) + mean(axis.guide.coulomb_N);
}

double viscous_Ns_per_m(const plant::AxisParameters& axis) {
  const double k = 2.0 * std::numbers::pi / axis.axis.lead_m;
  return mean(axis.motor.damping_Nms) * k * k + mean(axis.ball_screw.viscous_Ns_per_m) + mean(axis.guide.viscous_Ns_per_m);
}

/// They follow the axis: its mass, friction, lead and torque limit.
controllers::CascadeGains presets_of(const plant::AxisParameters& axis) {
  const double mass_kg = plant::make_axis_model(axis).mass_kg;
  return {.position_per_s = 150.0,
          .velocity_Ns_per_m = 400.0 * mass_kg,
          .velocity_integral_N_per_m = 4.0e4 * mass_kg,
          .velocity_feedforward = 1.0,
          .acceleration_feedforward_kg = mass_kg,
          .friction_feedforward_N = coulomb_N(axis),
          .viscous_feedforward_Ns_per_m = viscous_Ns_per_m(axis),
          .current_loop_time_constant_s = 0.0,
          .torque_limit_Nm = axis.axis.torque_limit_Nm,
          .lead_m = axis.axis.lead_m};
}

LoopbackSettings loopback_of(TomlFile& file, const std::string& table, const plant::AxisParameters& axis) {
  const auto at = [&table](const char* key) { return table + "." + key; };
  LoopbackSettings settings;
  const auto kinds = controllers::motion_kinds();
  std::vector<std::string> names;
  for (const auto& kind : kinds) names.emplace_back(kind.name);
  const auto chosen = file.word(at("motion"), names, "triangle");
  settings.motion = &*std::ranges::find(kinds, chosen, &controllers::MotionKind::name);

  auto& motion = settings.motion_settings;
  const double half_stroke = 0.5 * axis.axis.stroke_m;
  motion.centre_m = file.number(at("centre_m"), -100.0, 100.0, axis.axis.stroke_centre_m);
  motion.amplitude_m = file.number(at("amplitude_m"), 1e-6, 100.0, std::min(0.02, 0.8 * half_stroke));
  motion.speed_m_per_s = file.number(at("speed_m_per_s"), 1e-6, 10.0, 0.03);
  motion.acceleration_m_per_s2 = file.number(at("acceleration_m_per_s2"), 1e-3, 1e3, 1.0);
  motion.jerk_m_per_s3 = file.number(at("jerk_m_per_s3"), 1e-2, 1e6, 50.0);
  motion.dwell_s = file.number(at("dwell_s"), 0.0, 1e3, 0.2);
  motion.slowest_m_per_s = file.number(at("slowest_m_per_s"), 0.0, 10.0, 0.0);
  motion.steps = static_cast<int>(file.integer(at("steps"), 2, 1000, 10));
  motion.hold_s = file.number(at("hold_s"), 0.0, 1e3, 0.4);

  bool stands_in = false;
  if (const auto recording = file.text(at("recording")); settings.motion->of_recording) {
    if (!recording) file.fail(at("motion"), "a recorded motion needs the key recording: a CSV file beside this one");
    const auto beside = std::filesystem::path(file.path()).parent_path() / *recording;
    const Recording run = recording_from(read_csv(beside.string()), {});
    stands_in = !run.has(channel::reference_m);
    motion.path = stands_in ? recorded_motion_path(run, axis.axis.lead_m) : recorded_reference(run);
  }

  auto& gains = settings.gains;
  gains = stands_in ? stand_in_gains(axis) : presets_of(axis);
  const auto take = [&](const char* key, double highest, double& gain) { gain = file.number(at(key), 0.0, highest, gain); };
  take("position_per_s", 1e4, gains.position_per_s);
  take("velocity_Ns_per_m", 1e9, gains.velocity_Ns_per_m);
  take("velocity_integral_N_per_m", 1e12, gains.velocity_integral_N_per_m);
  take("velocity_feedforward", 2.0, gains.velocity_feedforward);
  take("acceleration_feedforward_kg", 1e5, gains.acceleration_feedforward_kg);
  take("friction_feedforward_N", 1e6, gains.friction_feedforward_N);
  take("viscous_feedforward_Ns_per_m", 1e7, gains.viscous_feedforward_Ns_per_m);
  take("current_loop_time_constant_s", 1.0, gains.current_loop_time_constant_s);
  return settings;
}

const io::PortKind* find_kind(std::string_view name) {
  const auto kinds = io::port_kinds();
  const auto found = std::ranges::find(kinds, name, &io::PortKind::name);
  return found == kinds.end() ? nullptr : &*found;
}

/// The name of a [[port]] table: its key "name", or else its kind.
std::string port_name(TomlFile& file, std::size_t i) {
  const std::string table = fmt::format("port[{}]", i);
  return file.text(table + ".name", file.text(table + ".kind", ""));
}

void add_port(std::string name, std::unique_ptr<io::Port> port, ServerConfig& config) {
  config.ports.push_back({std::move(name), std::move(port)});
}

bool has_port(const ServerConfig& config, std::string_view name) {
  return std::ranges::any_of(config.ports, [&](const auto& port) { return port.name == name; });
}

void read_ports(TomlFile& file, bool built_in, ServerConfig& config) {
  std::vector<std::string> kinds;
  for (const auto& kind : io::port_kinds()) kinds.emplace_back(kind.name);
  const auto context = config.context();
  const std::size_t count = file.tables_in("port");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string table = fmt::format("port[{}]", i);
    const auto kind = file.word(table + ".kind", kinds, "");
    if (kind.empty()) file.fail(table, fmt::format("kind is missing; expected one of {}", fmt::join(kinds, ", ")));
    const std::string name = port_name(file, i);
    if (name != kind && find_kind(name) != nullptr)
      file.fail(table + ".name", fmt::format("\"{}\" is the name of another kind of port", name));
    if (name.empty() || name == "loopback" || name == "program")
      file.fail(table + ".name", fmt::format("\"{}\" can't be a port's name", name));
    if (has_port(config, name))
      file.fail(table, fmt::format("a second port \"{}\": give each a name of its own (name = \"...\")", name));
    TomlSettings settings(file, table);
    add_port(name, find_kind(kind)->make(settings, context), config);
  }
  // without a word about ports: the two that need no hardware, and the one that is to command
  std::vector<std::string> presets;
  if (built_in || count == 0) presets = {"modbus", "udp"};
  presets.push_back(config.controller);
  for (const auto& name : presets) {
    const auto* kind = find_kind(name);
    if (kind == nullptr || has_port(config, name)) continue;
    TomlSettings settings(file, "preset." + name);
    add_port(name, kind->make(settings, context), config);
  }
}

/// Every port that a key may name: of the configuration, of the presets, and what commands from inside.
std::vector<std::string> controller_names(TomlFile& file, const ServerConfig& config) {
  std::vector<std::string> names{"loopback"};
  if (config.machine) names.emplace_back("program");
  for (const auto& kind : io::port_kinds()) names.emplace_back(kind.name);
  for (std::size_t i = 0; i < file.tables_in("port"); ++i) {
    if (auto name = port_name(file, i); std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

void read_faults(TomlFile& file, ServerConfig& config) {
  config.faults = faults_from(file, controller_names(file, config), config.controller, static_cast<int>(config.axes.size()));
  for (auto& [name, port] : config.ports) {
    auto own = faults_of(config.faults, name);
    if (!own.empty()) port = std::make_unique<io::faults::FaultPort>(std::move(port), std::move(own), config.context());
  }
}

void choose_controller(TomlFile& file, const std::optional<std::string>& asked, bool inside, ServerConfig& config) {
  const auto names = controller_names(file, config);
  if (asked) config.controller = *asked;
  if (inside) config.controller = config.machine ? "program" : "loopback";
  if (config.controller.empty()) config.controller = config.machine ? "program" : "modbus";
  if (std::ranges::find(names, config.controller) != names.end()) return;
  const auto problem = fmt::format("expected one of {}, found \"{}\"", fmt::join(names, ", "), config.controller);
  if (asked) throw InputError("--controller: " + problem);
  file.fail("server.controller", problem);
}

/// A machine file makes the plant a machine tool. Its axes are x and y; [controller] is the machine's own.
void read_machine(TomlFile& file, ServerConfig& config) {
  if (!is_machine_file(file)) return;
  if (!config.axes.empty()) file.fail("server.axes", "this file tells of a machine tool, whose axes are [x] and [y]");
  auto job = std::make_shared<MachineJob>(source_machine());
  job->name = file.path();
  apply_known(*job, file);
  if (file.has("server.period_s")) {
    job->tick_s = config.loop.tick_s;
  } else {
    config.loop.tick_s = job->tick_s;
  }
  config.axes = {job->machine.x, job->machine.y};
  config.axis_sources = {file.path() + " x", file.path() + " y"};
  config.machine = std::move(job);
}

}  // namespace

io::PortContext ServerConfig::context() const {
  io::PortContext context;
  context.axes = static_cast<int>(axes.size());
  context.tick_s = loop.tick_s;
  context.lockstep = pace == Pace::lockstep;
  for (const auto& axis : axes) {
    context.axis.push_back({axis.motor.rated_torque_Nm, axis.axis.lead_m, axis.axis.encoder_counts_per_rev});
  }
  return context;
}

ServerConfig read_server_config(const ConfigRequest& request) {
  const bool built_in = request.path.empty();
  TomlFile file = built_in ? TomlFile::parse("", "built-in configuration") : TomlFile::read(request.path);
  ServerConfig config;
  if (!built_in) config.source = request.path;
  read_server(file, config);
  read_axes(file, config);
  read_machine(file, config);
  if (config.axes.empty()) {
    config.axes.push_back(plant::source_axis());
    config.axis_sources.emplace_back("built in: the source's axis (Table 2)");
  }
  choose_controller(file, request.controller, request.commanded_inside, config);
  for (std::size_t i = 0; i < config.axes.size(); ++i) {
    const std::size_t tables = file.tables_in("loopback");
    const std::string table = tables > 0 ? fmt::format("loopback[{}]", std::min(i, tables - 1)) : "loopback";
    config.loopback.push_back(loopback_of(file, table, config.axes[i]));
  }
  read_ports(file, built_in, config);
  read_faults(file, config);
  file.reject_unknown();
  if (!request.with_ports) config.ports.clear();
  return config;
}

}  // namespace feedtwin::tools
