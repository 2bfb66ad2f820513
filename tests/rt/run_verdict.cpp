#include "rt/run_verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace feedtwin::rt {
namespace {

struct Run {
  Run() {
    stats.ticks = 10000;
    for (int i = 0; i < 10000; ++i) stats.wakeup.record(5000);
    facts.stats = &stats;
    facts.guards.resize(1);
  }
  TickStats stats;
  RunFacts facts;
};

TEST(RunVerdict, AQuietRunIsSoundWithoutAReason) {
  Run run;
  const auto verdict = judge(run.facts);
  EXPECT_EQ(verdict.verdict, Verdict::sound);
  EXPECT_TRUE(verdict.reasons.empty());
}

TEST(RunVerdict, EachThingThatCanGoWrongIsSaidAndWeighed) {
  struct Case {
    const char* what;
    Verdict expected;
    std::function<void(Run&)> spoil;
  };
  const Case cases[] = {
      {"denied", Verdict::not_valid_for_latency,
       [](Run& r) { r.facts.settings.push_back({"scheduling", "SCHED_FIFO 80", "denied", "no right", false}); }},
      {"missed", Verdict::not_valid_for_latency, [](Run& r) { r.stats.missed_ticks = 3; }},
      {"many missed", Verdict::unsound, [](Run& r) { r.stats.missed_ticks = 1000; }},
      {"late", Verdict::not_valid_for_latency,
       [](Run& r) {
         for (int i = 0; i < 100; ++i) r.stats.wakeup.record(400'000);
       }},
      {"stopped", Verdict::unsound, [](Run& r) { r.stats.stopped_by_overrun = true; }},
      {"dropped", Verdict::unsound, [](Run& r) { r.stats.dropped_records = 1; }},
      {"disk full", Verdict::unsound, [](Run& r) { r.facts.unwritten_rows = 1; }},
      {"balance", Verdict::unsound, [](Run& r) { r.facts.energy_balance_error = 0.01; }},
      {"not finite", Verdict::unsound, [](Run& r) { r.facts.finite = false; }},
      {"no tick", Verdict::unsound, [](Run& r) { r.stats.ticks = 0; }},
      {"port", Verdict::unsound,
       [](Run& r) { r.facts.counters.push_back({"gpio: edges", "above the edge rate", 5, true}); }},
      {"port note", Verdict::sound, [](Run& r) { r.facts.counters.push_back({"modbus: clients", "refused", 5, false}); }},
      {"watchdog", Verdict::sound, [](Run& r) { r.facts.guards[0].watchdog = 1; }},
      {"clipped", Verdict::sound, [](Run& r) { r.facts.guards[0].clipped = 1; }},
  };
  for (const auto& c : cases) {
    Run run;
    c.spoil(run);
    const auto verdict = judge(run.facts);
    EXPECT_EQ(verdict.verdict, c.expected) << c.what;
    EXPECT_EQ(verdict.reasons.size(), 1U) << c.what << ": said once";
  }
}

TEST(RunVerdict, OffLineLatenessMeansNothing) {
  Run run;
  run.facts.timed = false;
  for (int i = 0; i < 1000; ++i) run.stats.wakeup.record(4'000'000);
  EXPECT_EQ(judge(run.facts).verdict, Verdict::sound);
}

}  // namespace
}  // namespace feedtwin::rt
