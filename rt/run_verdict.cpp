#include "rt/run_verdict.h"

#include <algorithm>
#include <cstdio>

namespace feedtwin::rt {
namespace {

class Judge {
 public:
  void say(Verdict verdict, std::string reason) {
    result_.verdict = std::max(result_.verdict, verdict);
    result_.reasons.push_back(std::move(reason));
  }
  [[nodiscard]] RunVerdict result() && { return std::move(result_); }

 private:
  RunVerdict result_;
};

template <class... Values>
std::string text(const char* format, Values... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

void judge_timing(const RunFacts& facts, Judge& judge) {
  const TickStats& stats = *facts.stats;
  for (const auto& setting : facts.settings) {
    if (!setting.granted) {
      judge.say(Verdict::not_valid_for_latency,
                setting.what + ": asked for " + setting.asked + ", got " + setting.got + " (" + setting.why + ")");
    }
  }
  if (stats.missed_ticks > 0) {
    const double share = static_cast<double>(stats.missed_ticks) / static_cast<double>(stats.missed_ticks + stats.ticks);
    judge.say(share > tolerated_missed_share ? Verdict::unsound : Verdict::not_valid_for_latency,
              text("%llu of %llu ticks missed", static_cast<unsigned long long>(stats.missed_ticks),
                   static_cast<unsigned long long>(stats.missed_ticks + stats.ticks)));
  }
  if (stats.late_starts > 0) {
    judge.say(Verdict::not_valid_for_latency, text("%llu ticks began late because the one before ended late",
                                                   static_cast<unsigned long long>(stats.late_starts)));
  }
  const double late_us = stats.wakeup.percentile_us(0.999);
  const double tolerated_us = 0.1 * facts.tick_s * 1e6;
  if (late_us > tolerated_us) {
    judge.say(Verdict::not_valid_for_latency,
              text("one tick in a thousand began more than %.0f us late (a tenth of the period is %.0f us)", late_us,
                   tolerated_us));
  }
  if (stats.stopped_by_overrun) judge.say(Verdict::unsound, "stopped at the first missed tick, as configured");
}

void judge_commands(const RunFacts& facts, Judge& judge) {
  for (std::size_t i = 0; i < facts.guards.size(); ++i) {
    const GuardCounters& guard = facts.guards[i];
    const auto note = [&](std::uint64_t count, const char* what) {
      if (count > 0) judge.say(Verdict::sound, text("axis %zu: %llu %s", i, static_cast<unsigned long long>(count), what));
    };
    note(guard.watchdog, "times the watchdog took the torque away");
    note(guard.lost, "commands lost on the way");
    note(guard.repeated, "commands with a repeated sequence number");
    note(guard.reordered, "commands out of order, not used");
    note(guard.refused, "commands refused: not a finite number");
    note(guard.clipped, "ticks with the torque clipped to the drive's limit");
  }
  for (const auto& counter : facts.counters) {
    if (counter.value > 0) {
      judge.say(counter.loses_data ? Verdict::unsound : Verdict::sound,
                text("%s: %llu (%s)", counter.name.c_str(), static_cast<unsigned long long>(counter.value),
                     counter.meaning.c_str()));
    }
  }
}

}  // namespace

std::string_view name(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::sound:
      return "sound";
    case Verdict::not_valid_for_latency:
      return "not-valid-for-latency";
    case Verdict::unsound:
      return "unsound";
  }
  return "";
}

RunVerdict judge(const RunFacts& facts) {
  Judge judge;
  const TickStats& stats = *facts.stats;
  if (stats.ticks == 0) judge.say(Verdict::unsound, "no tick was run");
  if (!facts.finite) judge.say(Verdict::unsound, "the plant's state is not finite");
  if (facts.energy_balance_error > tolerated_balance_error) {
    judge.say(Verdict::unsound, text("the energy balance is open by %.2g of the work", facts.energy_balance_error));
  }
  if (facts.timed) judge_timing(facts, judge);
  if (stats.dropped_records > 0) {
    judge.say(Verdict::unsound, text("%llu log rows dropped: the writer was too slow",
                                     static_cast<unsigned long long>(stats.dropped_records)));
  }
  if (facts.unwritten_rows > 0) {
    judge.say(Verdict::unsound, text("%llu log rows could not be written (disk full?)",
                                     static_cast<unsigned long long>(facts.unwritten_rows)));
  }
  if (stats.dropped_events > 0) {
    judge.say(Verdict::sound,
              text("%llu events dropped from the log", static_cast<unsigned long long>(stats.dropped_events)));
  }
  judge_commands(facts, judge);
  return std::move(judge).result();
}

}  // namespace feedtwin::rt
