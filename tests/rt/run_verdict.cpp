#include "rt/run_verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace feedtwin::rt {
namespace {

struct Facts {
  Facts() {
    stats.ticks = 10000;
    for (int i = 0; i < 10000; ++i) stats.wakeup.record(5000);
    facts.stats = &stats;
    facts.guards.resize(1);
  }
  TickStats stats;
  RunFacts facts;
};

TEST(RunVerdict, AQuietRunIsSoundWithoutAReason) {
  Facts run;
  const auto verdict = judge(run.facts);
  EXPECT_EQ(verdict.verdict, Verdict::sound);
  EXPECT_TRUE(verdict.reasons.empty());
}

TEST(RunVerdict, EachThingThatCanGoWrongIsSaidAndWeighed) {
  struct Case {
    const char* what;
    Verdict expected;
    std::function<void(Facts&)> spoil;
  };
  const Case cases[] = {
      {"denied", Verdict::not_valid_for_latency,
       [](Facts& r) { r.facts.settings.push_back({"scheduling", "SCHED_FIFO 80", "denied", "no right", false}); }},
      {"missed", Verdict::not_valid_for_latency, [](Facts& r) { r.stats.missed_ticks = 3; }},
      {"late start", Verdict::not_valid_for_latency, [](Facts& r) { r.stats.late_starts = 1; }},
      {"many missed", Verdict::unsound, [](Facts& r) { r.stats.missed_ticks = 1000; }},
      {"late", Verdict::not_valid_for_latency,
       [](Facts& r) {
         for (int i = 0; i < 100; ++i) r.stats.wakeup.record(400'000);
       }},
      {"stopped", Verdict::unsound, [](Facts& r) { r.stats.stopped_by_overrun = true; }},
      {"dropped", Verdict::unsound, [](Facts& r) { r.stats.dropped_records = 1; }},
      {"disk full", Verdict::unsound, [](Facts& r) { r.facts.unwritten_rows = 1; }},
      {"balance", Verdict::unsound, [](Facts& r) { r.facts.energy_balance_error = 0.01; }},
      {"not finite", Verdict::unsound, [](Facts& r) { r.facts.finite = false; }},
      {"no tick", Verdict::unsound, [](Facts& r) { r.stats.ticks = 0; }},
      {"port", Verdict::unsound,
       [](Facts& r) { r.facts.counters.push_back({"gpio: edges", "above the edge rate", 5, true}); }},
      {"port note", Verdict::sound, [](Facts& r) { r.facts.counters.push_back({"modbus: clients", "refused", 5, false}); }},
      {"watchdog", Verdict::sound, [](Facts& r) { r.facts.guards[0].watchdog = 1; }},
      {"clipped", Verdict::sound, [](Facts& r) { r.facts.guards[0].clipped = 1; }},
  };
  for (const auto& c : cases) {
    Facts run;
    c.spoil(run);
    const auto verdict = judge(run.facts);
    EXPECT_EQ(verdict.verdict, c.expected) << c.what;
    EXPECT_EQ(verdict.reasons.size(), 1U) << c.what << ": said once";
  }
}

TEST(RunVerdict, OffLineLatenessMeansNothing) {
  Facts run;
  run.facts.timed = false;
  for (int i = 0; i < 1000; ++i) run.stats.wakeup.record(4'000'000);
  EXPECT_EQ(judge(run.facts).verdict, Verdict::sound);
}

}  // namespace
}  // namespace feedtwin::rt
