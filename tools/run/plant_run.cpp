#include "tools/run/plant_run.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "tools/config/input_error.h"

namespace feedtwin::tools {

PlantRun::PlantRun(ServerConfig config, std::uint64_t ticks) : config_(std::move(config)) {
  config_.loop.ticks = ticks;
  if (config_.machine) {
    machine_ = std::make_unique<rt::MachinePlant>(config_.machine->machine, config_.machine->block,
                                                  config_.log_path.empty() ? 0 : config_.loop.record_capacity);
  } else {
    for (const auto& parameters : config_.axes) axes_.emplace_back(parameters);
    plant_of_axes_ = std::make_unique<rt::AxesPlant>(axes_);
  }
  if (config_.controller == "program") {
    program_ = std::make_unique<ProgramPort>(*config_.machine);
    if (ticks == 0) config_.loop.ticks = program_->ticks();
  }
  if (config_.controller == "loopback") loopback_ = std::make_unique<LoopbackPort>(config_.loopback, config_.context());
  if (loopback_ && !axes_.empty()) {
    for (std::size_t i = 0; i < axes_.size(); ++i)  // a recording begins where it begins
      if (config_.loopback[i].motion->of_recording) axes_[i].place(loopback_->reference_m(i, 0));
  }
  if (auto own = faults_of(config_.faults, config_.controller); inner_controller() != nullptr && !own.empty()) {
    faulty_inner_ = std::make_unique<io::faults::FaultPort>(*inner_controller(), std::move(own), config_.context());
  }
  make_log();
  for (const auto& [name, port] : config_.ports) {
    try {
      port->open();
    } catch (const io::PortError& error) {
      throw InputError(fmt::format("port {}: {}", name, error.what()));
    }
  }
}

PlantRun::~PlantRun() {
  for (const auto& [name, port] : config_.ports) port->close();
}

rt::SteppedPlant& PlantRun::plant() {
  return machine_ ? static_cast<rt::SteppedPlant&>(*machine_) : *plant_of_axes_;
}

const plant::FeedAxis& PlantRun::axis(std::size_t i) const {
  return machine_ ? machine_->axis(i) : axes_[i];
}

void PlantRun::make_log() {
  RunLogSettings settings;
  settings.path = config_.log_path;
  settings.tick_s = config_.loop.tick_s;
  settings.late_us = config_.loop.late_us;
  settings.with_forces = config_.loop.record_forces;
  for (std::size_t i = 0; i < config_.axes.size(); ++i) settings.m_per_count.push_back(axis(i).encoder().resolution_m());
  settings.machine = machine_.get();
  if (loopback_) {
    settings.reference_m = [port = loopback_.get()](std::size_t axis, std::uint64_t tick) {
      return port->reference_m(axis, tick);
    };
  } else if (program_) {
    settings.reference_m = [port = program_.get()](std::size_t axis, std::uint64_t tick) {
      return port->reference_m(axis, tick);
    };
  }
  log_ = std::make_unique<RunLog>(settings);
}

io::Port* PlantRun::inner_controller() {
  if (loopback_) return loopback_.get();
  return program_.get();
}

io::Port& PlantRun::commanding_port() {
  if (faulty_inner_) return *faulty_inner_;
  if (io::Port* inner = inner_controller(); inner != nullptr) return *inner;
  for (const auto& [name, port] : config_.ports) {
    if (name == config_.controller) return *port;
  }
  throw InputError("controller " + config_.controller + ": no such port is configured");
}

void PlantRun::make_loop(rt::TickClock& clock) {
  io::Port& commanding = commanding_port();
  std::vector<io::Port*> listening;
  for (const auto& [name, port] : config_.ports) {
    if (port.get() != &commanding) listening.push_back(port.get());
  }
  loop_ = std::make_unique<rt::PlantLoop>(plant(), commanding, listening, clock, config_.loop);
}

void PlantRun::run_in_real_time(std::atomic<bool>& stop) {
  const auto period_ns = static_cast<std::int64_t>(std::llround(config_.loop.tick_s * 1e9));
  timed_ = config_.pace == Pace::free_running;
  if (timed_) {
    clock_ = std::make_unique<rt::GridClock>(period_ns, config_.overrun);
  } else {
    if (!commanding_port().can_step_the_plant()) {
      throw InputError(config_.source, 0, "server.pace", "controller " + config_.controller + " can't step the plant");
    }
    clock_ = std::make_unique<rt::LockstepClock>(commanding_port(), config_.lockstep_timeout_ns, stop);
  }
  make_loop(*clock_);
  const rt::RtProcess process(config_.real_time);
  settings_ = process.reports();
  if (config_.real_time.real_time) settings_.insert(settings_.begin(), rt::kernel_report());
  log_->start(*loop_);

  std::atomic<bool> ended{false};
  std::vector<rt::SettingReport> thread_settings;
  std::thread real_time([&] {
    thread_settings = rt::make_thread_real_time(config_.real_time);
    loop_->run(stop);
    ended.store(true, std::memory_order_release);
  });
  show_progress(stop, ended);
  real_time.join();
  settings_.insert(settings_.end(), thread_settings.begin(), thread_settings.end());
  for (const auto& [name, port] : config_.ports) port->close();
  note_port_events();
  log_->finish();
}

std::vector<PlantRun::Reporting> PlantRun::reporting_ports() const {
  std::vector<Reporting> ports;
  for (const auto& [name, port] : config_.ports) ports.push_back({name, port.get()});
  if (faulty_inner_) ports.push_back({config_.controller, faulty_inner_.get()});
  return ports;
}

void PlantRun::note_port_events() {
  for (const auto& [name, port] : reporting_ports()) {
    for (const auto& event : port->take_events()) log_->note(event.time_s, fmt::format("{}: {}", name, event.text));
  }
}

void PlantRun::show_progress(std::atomic<bool>& stop, const std::atomic<bool>& ended) {
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  const double total_s = static_cast<double>(config_.loop.ticks) * config_.loop.tick_s;
  auto shown = std::chrono::steady_clock::now();
  while (!ended.load(std::memory_order_acquire)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    note_port_events();
    const auto now = std::chrono::steady_clock::now();
    if (now - shown < std::chrono::seconds(terminal ? 1 : 10)) continue;
    shown = now;
    const double done_s = static_cast<double>(loop_->heartbeat()) * config_.loop.tick_s;
    fmt::print(stderr, "{}{:.0f} s{}{}", terminal ? "\r" : "", done_s,
               total_s > 0 ? fmt::format(" of {:.0f} s", total_s) : "", terminal ? " " : "\n");
  }
  if (terminal) fmt::print(stderr, "\r                        \r");
  stop.store(true);
}

void PlantRun::run_off_line() {
  if (inner_controller() == nullptr)
    throw InputError("simulate runs a controller of its own; controller = \"" + config_.controller + "\" has no wire here");
  clock_ = std::make_unique<rt::OfflineClock>(static_cast<std::int64_t>(std::llround(config_.loop.tick_s * 1e9)));
  config_.loop.record_work = false;
  const std::uint64_t ticks = config_.loop.ticks;
  const std::atomic<bool> stop{false};
  // in pieces that the log's ring takes whole, so that one thread can run and write in turn
  make_loop(*clock_);
  const std::uint64_t piece = config_.loop.record_capacity / 2;
  for (std::uint64_t done = 0; done < ticks; done += piece) {
    loop_->run_to(std::min(ticks, done + piece), stop);
    log_->drain(*loop_);
    note_port_events();
  }
  log_->finish();
}

MachineFacts PlantRun::machine_facts() const {
  MachineFacts facts;
  facts.energy = machine_->machine().energy();
  if (program_) facts.contour_peak_m = program_->contour_peak_m();
  return facts;
}

std::vector<io::Counter> PlantRun::machine_counters() const {
  const auto count = [](auto value) { return static_cast<std::uint64_t>(value); };
  return {{"machine: stalled_ticks", "ticks that pushed the tool into material with the spindle standing, without force",
           count(machine_->machine().stalled_ticks()), false},
          {"machine: clipped_inputs", "inputs that were not finite or beyond a limit",
           count(machine_->machine().clipped_inputs()), false},
          {"machine: dropped_rows", "log rows dropped: the writer was too slow", machine_->dropped_records(), true}};
}

RunSummary PlantRun::summary(const std::string& verb) {
  RunSummary summary;
  summary.verb = verb;
  summary.source = config_.source;
  summary.controller = config_.controller;
  summary.tick_s = config_.loop.tick_s;
  summary.stats = &loop_->stats();
  summary.settings = settings_;
  summary.parameter_hash = parameter_hash(config_.axes);
  summary.files = log_->paths();

  rt::RunFacts facts;
  facts.timed = timed_;
  facts.tick_s = config_.loop.tick_s;
  facts.stats = &loop_->stats();
  facts.settings = settings_;
  facts.unwritten_rows = log_->unwritten_rows();
  for (std::size_t i = 0; i < config_.axes.size(); ++i) {
    summary.energy.push_back(axis(i).energy());
    facts.guards.push_back(loop_->guard(i).counters());
    facts.energy_balance_error = std::max(facts.energy_balance_error, summary.energy.back().balance_error());
    facts.finite =
        facts.finite && std::isfinite(axis(i).state().position_m) && std::isfinite(axis(i).state().velocity_m_per_s);
  }
  if (machine_) {
    summary.machine = machine_facts();
    facts.energy_balance_error = std::max(facts.energy_balance_error, summary.machine->energy.balance_error());
    facts.counters = machine_counters();
  }
  for (const auto& [name, port] : reporting_ports()) {
    for (auto& counter : port->counters()) {
      counter.name = fmt::format("{}: {}", name, counter.name);
      facts.counters.push_back(std::move(counter));
    }
  }
  summary.verdict = rt::judge(facts);
  return summary;
}

}  // namespace feedtwin::tools
