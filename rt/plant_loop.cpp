#include "rt/plant_loop.h"

#include <cmath>

#include "io/monotonic.h"

namespace feedtwin::rt {

PlantLoop::PlantLoop(SteppedPlant& plant, io::Port& commanding, std::vector<io::Port*> listening, TickClock& clock,
                     const LoopSettings& settings)
    : PlantLoop(nullptr, &plant, commanding, std::move(listening), clock, settings) {}

PlantLoop::PlantLoop(std::vector<plant::FeedAxis>& axes, io::Port& commanding, std::vector<io::Port*> listening,
                     TickClock& clock, const LoopSettings& settings)
    : PlantLoop(std::make_unique<AxesPlant>(axes), nullptr, commanding, std::move(listening), clock, settings) {}

PlantLoop::PlantLoop(std::unique_ptr<SteppedPlant> own, SteppedPlant* plant, io::Port& commanding,
                     std::vector<io::Port*> listening, TickClock& clock, const LoopSettings& settings)
    : own_(std::move(own)),
      plant_(plant != nullptr ? *plant : *own_),
      commanding_(commanding),
      listening_(std::move(listening)),
      clock_(clock),
      settings_(settings),
      quick_stops_(plant_.axes()),
      requests_(plant_.axes()),
      torques_Nm_(plant_.axes()),
      reports_(plant_.axes()),
      rows_(plant_.axes()),
      records_(settings.record_capacity * plant_.axes()),
      events_(1024),
      stats_(std::make_unique<TickStats>()) {
  for (std::size_t i = 0; i < plant_.axes(); ++i) {
    guards_.emplace_back(GuardLimits{plant_.axis(i).parameters().axis.torque_limit_Nm, settings.watchdog_ns});
    reports_[i].encoder_counts = plant_.axis(i).signals().encoder_counts;
  }
}

void PlantLoop::run_to(std::uint64_t ticks, const std::atomic<bool>& stop) noexcept {
  if (!started_) {
    started_ = true;
    const io::TickReport before{0, 0, clock_.start()};
    commanding_.send(before, reports_);  // what the controller sees before the first tick
  }
  while (!stop.load(std::memory_order_relaxed) && (ticks == 0 || stats_->ticks < ticks)) {
    const TickStart start = clock_.wait();
    if (!start.proceed) {
      stats_->missed_ticks += start.missed;
      stats_->stopped_by_overrun = start.missed > 0;
      break;
    }
    tick(start);
  }
}

void PlantLoop::tick(const TickStart& start) noexcept {
  const std::int64_t begin_ns = io::monotonic_ns();
  const std::int64_t late_ns = start.woken_ns - start.planned_ns;
  lateness_us_ = static_cast<double>(late_ns) * 1e-3;
  if (start.slept) stats_->wakeup.record(late_ns);
  stats_->late_starts += start.slept ? 0 : 1;
  stats_->missed_ticks += start.missed;
  if (start.missed > 0) note(EventKind::missed_ticks, -1, static_cast<double>(start.missed));
  if (lateness_us_ > settings_.late_us) note(EventKind::late_tick, -1, lateness_us_);

  const std::uint64_t fresh = commanding_.receive(requests_);
  commanding_.receive_machine(machine_request_);
  for (std::size_t i = 0; i < rows_.size(); ++i) command_axis(i, ((fresh >> i) & 1U) != 0, start.woken_ns);
  plant_.step(torques_Nm_, machine_in_force(), settings_.tick_s);
  for (std::size_t i = 0; i < rows_.size(); ++i) report_axis(i);

  const io::TickReport report{stats_->ticks, stats_->missed_ticks, start.woken_ns};
  commanding_.send(report, reports_);
  for (io::Port* port : listening_) port->send(report, reports_);
  if (!records_.push(rows_)) stats_->dropped_records += rows_.size();

  const std::int64_t work_ns = io::monotonic_ns() - begin_ns;
  if (settings_.record_work) last_work_us_ = static_cast<double>(work_ns) * 1e-3;
  stats_->work.record(work_ns);
  ++stats_->ticks;
  heartbeat_.store(stats_->ticks, std::memory_order_relaxed);
}

void PlantLoop::command_axis(std::size_t i, bool fresh, std::int64_t now_ns) noexcept {
  const plant::FeedAxis& axis = plant_.axis(i);
  CommandGuard::Decision decision = guards_[i].decide(requests_[i], fresh, now_ns);
  if (guards_[i].state() == io::DriveState::quick_stop) {
    decision.torque_Nm = quick_stops_[i].torque_Nm(axis, guards_[i].in_force(), settings_.tick_s);
  } else {
    quick_stops_[i].idle();
  }
  if (fresh && decision.age_ns >= 0) stats_->input_age.record(decision.age_ns);
  if (fresh && requests_[i].reply_ns >= 0) stats_->reply.record(requests_[i].reply_ns);
  if (decision.event) note(*decision.event, static_cast<std::int32_t>(i), decision.event_value);

  torques_Nm_[i] = decision.torque_Nm;
  AxisRecord& row = rows_[i];
  row.tick = stats_->ticks;
  row.axis = static_cast<std::int32_t>(i);
  row.state = guards_[i].state();
  row.encoder_counts = axis.signals().encoder_counts;
  row.scale_position_m = axis.signals().scale_position_m;
  row.torque_command_Nm = decision.torque_Nm;
  row.metered_power_W = axis.signals().metered_power_W;
  if (settings_.record_forces) {
    const plant::ForceSignals forces = axis.force_sensors({decision.torque_Nm, plant_.process_force_N(i)});
    row.torque_sensor_Nm = forces.torque_sensor_Nm;
    row.force_sensor_N = forces.force_sensor_N;
  }
  row.lateness_us = lateness_us_;
  row.work_us = last_work_us_;
  row.input_age_us = static_cast<double>(decision.age_ns) * 1e-3;
  reports_[i].input_age_ns = decision.age_ns;
}

void PlantLoop::report_axis(std::size_t i) noexcept {
  const plant::AxisSignals& signals = plant_.axis(i).signals();
  io::AxisReport& report = reports_[i];
  report.ticks_done = stats_->ticks + 1;
  report.encoder_counts = signals.encoder_counts;
  report.velocity_m_per_s = signals.velocity_m_per_s;
  report.torque_Nm = signals.torque_Nm;
  report.sequence = guards_[i].sequence();
  report.state = guards_[i].state();
  report.index_passed = signals.index_passed;
  watch_end_stops(i);
}

io::MachineRequest PlantLoop::machine_in_force() const noexcept {
  bool enabled = false, fault = false;
  for (const CommandGuard& guard : guards_) {
    enabled = enabled || guard.state() == io::DriveState::enabled;
    fault = fault || guard.state() == io::DriveState::fault;
  }
  return enabled && !fault ? machine_request_ : io::MachineRequest{};
}

void PlantLoop::watch_end_stops(std::size_t i) noexcept {
  const auto& model = plant_.axis(i).model();
  const double position_m = plant_.axis(i).signals().position_m;
  io::AxisReport& report = reports_[i];
  const bool was_out = report.at_low_stop || report.at_high_stop;
  report.at_low_stop = position_m <= model.stop_low_m;
  report.at_high_stop = position_m >= model.stop_high_m;
  if (!was_out && (report.at_low_stop || report.at_high_stop)) {
    note(EventKind::end_stop, static_cast<std::int32_t>(i), report.velocity_m_per_s);
  }
}

void PlantLoop::note(EventKind kind, std::int32_t axis, double value) noexcept {
  if (!events_.push(Event{stats_->ticks, kind, axis, value})) ++stats_->dropped_events;
}

}  // namespace feedtwin::rt
