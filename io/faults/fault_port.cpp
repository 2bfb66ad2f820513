#include "io/faults/fault_port.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::io::faults {

FaultPort::FaultPort(std::unique_ptr<Port> inner, const std::vector<Fault>& faults, const PortContext& context)
    : FaultPort(*inner, faults, context) {
  owned_ = std::move(inner);
}

FaultPort::FaultPort(Port& inner, const std::vector<Fault>& faults, const PortContext& context)
    : inner_(inner), tick_s_(context.tick_s), happenings_(2 * faults.size()) {
  const auto axes = static_cast<std::size_t>(context.axes);
  for (const auto& fault : faults) faults_.push_back({fault, false, false});
  for (std::size_t i = 0; i < axes; ++i) commands_.emplace_back(i + 1);
  counts_.resize(axes);
  requests_.resize(axes);
  reports_.resize(axes);
}

/// Begin and end what is due by now.
void FaultPort::advance(double now_s) noexcept FEEDTWIN_REALTIME {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    auto& timed = faults_[i];
    const bool acts = !timed.over && now_s >= timed.fault.at_s && now_s < timed.fault.at_s + timed.fault.for_s;
    const bool once = timed.fault.kind == FaultKind::lost_counts;
    const bool begins = once ? !timed.over && now_s >= timed.fault.at_s : acts && !timed.active;
    if (begins || (timed.active && !acts)) {
      timed.active = begins && !once;
      timed.over = once || !begins;
      switch_encoder(timed.fault, begins);
      const std::size_t n = happened_.load(std::memory_order_relaxed);
      happenings_[n] = {now_s, i, begins};
      happened_.store(n + 1, std::memory_order_release);
    }
  }
}

void FaultPort::switch_encoder(const Fault& fault, bool on) noexcept FEEDTWIN_REALTIME {
  const auto& encoder = named(fault.kind).encoder;
  if (!encoder) return;
  for (std::size_t axis = 0; axis < counts_.size(); ++axis) {
    if (!concerns(fault, axis)) continue;
    const bool on_its_own_lines = inner_.break_encoder(*encoder, static_cast<int>(axis), on, fault.counts);
    if (!on_its_own_lines) counts_[axis].set(*encoder, on, fault.counts);
  }
}

CommandConditions FaultPort::conditions(int axis) const noexcept FEEDTWIN_REALTIME {
  CommandConditions now;
  for (const auto& timed : faults_) {
    if (!timed.active || !concerns(timed.fault, static_cast<std::size_t>(axis))) continue;
    switch (timed.fault.kind) {
      case FaultKind::lost_command:
        now.lost = std::max(now.lost, timed.fault.share);
        break;
      case FaultKind::late_command:
        now.late = std::max(now.late, timed.fault.share);
        now.delay_ticks = std::max(now.delay_ticks, static_cast<std::uint64_t>(std::llround(timed.fault.delay_s / tick_s_)));
        break;
      case FaultKind::repeated_command:
        now.repeated = std::max(now.repeated, timed.fault.share);
        break;
      case FaultKind::corrupted_command:
        now.corrupted = std::max(now.corrupted, timed.fault.share);
        break;
      default:
        break;
    }
  }
  return now;
}

std::uint64_t FaultPort::receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME {
  advance(static_cast<double>(tick_) * tick_s_);
  const std::uint64_t came = inner_.receive(requests_);
  std::uint64_t through = 0;
  for (std::size_t i = 0; i < commands_.size() && i < newest.size(); ++i) {
    const bool any =
        commands_[i].pass(requests_[i], (came >> i & 1U) != 0, tick_, conditions(static_cast<int>(i)), newest[i]);
    if (any) through |= std::uint64_t{1} << i;
  }
  return through;
}

void FaultPort::send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME {
  tick_ = tick.tick + 1;
  advance(static_cast<double>(tick.tick) * tick_s_);
  const std::size_t n = std::min(axes.size(), reports_.size());
  for (std::size_t i = 0; i < n; ++i) {
    reports_[i] = axes[i];
    counts_[i].apply(reports_[i]);
  }
  inner_.send(tick, std::span<const AxisReport>(reports_).first(n));
}

std::vector<Counter> FaultPort::counters() const {
  auto all = inner_.counters();
  CommandFaultCounters sum;
  for (const auto& command : commands_) {
    sum.lost += command.counters().lost;
    sum.late += command.counters().late;
    sum.repeated += command.counters().repeated;
    sum.corrupted += command.counters().corrupted;
    sum.no_room += command.counters().no_room;
  }
  all.push_back({"fault lost", "commands lost on purpose", sum.lost + sum.no_room, false});
  all.push_back({"fault late", "commands delayed on purpose", sum.late, false});
  all.push_back({"fault repeated", "commands repeated on purpose", sum.repeated, false});
  all.push_back({"fault corrupted", "commands corrupted on purpose", sum.corrupted, false});
  return all;
}

std::vector<PortEvent> FaultPort::take_events() {
  auto events = inner_.take_events();
  const std::size_t happened = happened_.load(std::memory_order_acquire);
  for (; told_ < happened; ++told_) {
    const auto& happening = happenings_[told_];
    const auto& fault = faults_[happening.fault].fault;
    const auto& kind = named(fault.kind);
    std::string text = "fault on purpose";
    if (fault.axis >= 0) text += ", axis " + std::to_string(fault.axis);
    text += ": " + std::string(kind.name) + (happening.begins ? " (" + std::string(kind.meaning) + ")" : " ends");
    events.push_back({happening.time_s, std::move(text)});
  }
  return events;
}

}  // namespace feedtwin::io::faults
