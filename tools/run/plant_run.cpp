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
  for (const auto& parameters : config_.axes) axes_.emplace_back(parameters);
  if (config_.controller == "loopback") loopback_ = std::make_unique<LoopbackPort>(config_.loopback, config_.context());
  if (auto own = faults_of(config_.faults, "loopback"); loopback_ && !own.empty()) {
    faulty_loopback_ = std::make_unique<io::faults::FaultPort>(*loopback_, std::move(own), config_.context());
  }
  make_log();
  for (const auto& port : config_.ports) {
    try {
      port->open();
    } catch (const io::PortError& error) {
      throw InputError(fmt::format("port {}: {}", port->name(), error.what()));
    }
  }
}

PlantRun::~PlantRun() {
  for (const auto& port : config_.ports) port->close();
}

void PlantRun::make_log() {
  RunLogSettings settings;
  settings.path = config_.log_path;
  settings.tick_s = config_.loop.tick_s;
  settings.late_us = config_.loop.late_us;
  settings.with_forces = config_.loop.record_forces;
  for (const auto& axis : axes_) settings.m_per_count.push_back(axis.encoder().resolution_m());
  if (loopback_) {
    settings.reference_m = [port = loopback_.get()](std::size_t axis, std::uint64_t tick) {
      return port->reference_m(axis, tick);
    };
  }
  log_ = std::make_unique<RunLog>(settings);
}

io::Port& PlantRun::commanding_port() {
  if (faulty_loopback_) return *faulty_loopback_;
  if (loopback_) return *loopback_;
  for (const auto& port : config_.ports) {
    if (port->name() == config_.controller) return *port;
  }
  throw InputError("controller " + config_.controller + ": no such port is configured");
}

void PlantRun::make_loop(rt::TickClock& clock) {
  io::Port& commanding = commanding_port();
  std::vector<io::Port*> listening;
  for (const auto& port : config_.ports) {
    if (port.get() != &commanding) listening.push_back(port.get());
  }
  loop_ = std::make_unique<rt::PlantLoop>(axes_, commanding, listening, clock, config_.loop);
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
  for (const auto& port : config_.ports) port->close();
  note_port_events();
  log_->finish();
}

std::vector<io::Port*> PlantRun::reporting_ports() const {
  std::vector<io::Port*> ports;
  for (const auto& port : config_.ports) ports.push_back(port.get());
  if (faulty_loopback_) ports.push_back(faulty_loopback_.get());
  return ports;
}

void PlantRun::note_port_events() {
  for (auto* port : reporting_ports()) {
    for (const auto& event : port->take_events()) log_->note(event.time_s, fmt::format("{}: {}", port->name(), event.text));
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
  if (!loopback_)
    throw InputError("simulate runs the loopback controller; controller = \"" + config_.controller + "\" has no wire here");
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
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    summary.energy.push_back(axes_[i].energy());
    facts.guards.push_back(loop_->guard(i).counters());
    facts.energy_balance_error = std::max(facts.energy_balance_error, summary.energy.back().balance_error());
    facts.finite =
        facts.finite && std::isfinite(axes_[i].state().position_m) && std::isfinite(axes_[i].state().velocity_m_per_s);
  }
  for (const auto* port : reporting_ports()) {
    for (auto& counter : port->counters()) {
      counter.name = fmt::format("{}: {}", port->name(), counter.name);
      facts.counters.push_back(std::move(counter));
    }
  }
  summary.verdict = rt::judge(facts);
  return summary;
}

}  // namespace feedtwin::tools
