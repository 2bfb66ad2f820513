#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tools/check/findings.h"

namespace feedtwin::tools {
namespace {

HostFacts good_host() {
  HostFacts facts;
  facts.kernel = "6.1.0-rt #1 SMP PREEMPT_RT";
  facts.real_time_kernel = true;
  facts.priority_limit = 99;
  facts.memory_lock_unlimited = true;
  facts.cpu_latency_writable = true;
  facts.clock_source = "tsc";
  facts.cpus = 4;
  facts.governors = {"performance", "performance"};
  facts.isolated = "3";
  facts.can_interfaces = {"can0"};
  facts.gpio_chips = {"gpiochip0"};
  return facts;
}

const Finding& find(const std::vector<Finding>& findings, const std::string& what) {
  for (const auto& finding : findings)
    if (finding.what == what) return finding;
  throw std::out_of_range(what);
}

TEST(Check, AGoodHostHasNothingToChange) {
  const auto findings = findings_on(good_host());
  EXPECT_EQ(findings.size(), 11U);
  for (const auto& finding : findings) {
    EXPECT_EQ(finding.fitness, Fitness::fit) << finding.what;
    EXPECT_EQ(finding.change, "") << finding.what;
  }
  EXPECT_TRUE(fit_for_real_time(findings));
}

TEST(Check, EachShortcomingIsFoundAloneAndSaysWhatToChange) {
  struct Case {
    const char* what;
    Fitness fitness;
    void (*spoil)(HostFacts&);
  };
  const Case cases[] = {
      {"kernel", Fitness::unfit, [](HostFacts& f) { f.real_time_kernel = false; }},
      {"scheduler rights", Fitness::unfit, [](HostFacts& f) { f.priority_limit = 0; }},
      {"scheduler rights", Fitness::unfit, [](HostFacts& f) { f.priority_limit = 50; }},
      {"real-time share", Fitness::improvable, [](HostFacts& f) { f.rt_runtime_us = 950'000; }},
      {"memory locking", Fitness::unfit,
       [](HostFacts& f) {
         f.memory_lock_unlimited = false;
         f.memory_lock_MiB = 8;
       }},
      {"idle states", Fitness::improvable, [](HostFacts& f) { f.cpu_latency_writable = false; }},
      {"clock source", Fitness::improvable, [](HostFacts& f) { f.clock_source = "hpet"; }},
      {"clock source", Fitness::improvable, [](HostFacts& f) { f.clock_source = ""; }},
      {"frequency governor", Fitness::improvable, [](HostFacts& f) { f.governors[1] = "powersave"; }},
      {"processors", Fitness::improvable, [](HostFacts& f) { f.isolated = ""; }},
      {"processors", Fitness::improvable, [](HostFacts& f) { f.cpus = 1; }},
      {"machine", Fitness::improvable, [](HostFacts& f) { f.virtual_machine = true; }},
      {"CAN", Fitness::improvable, [](HostFacts& f) { f.can_interfaces.clear(); }},
      {"GPIO", Fitness::improvable, [](HostFacts& f) { f.gpio_chips.clear(); }},
  };
  for (const auto& c : cases) {
    HostFacts facts = good_host();
    c.spoil(facts);
    const auto findings = findings_on(facts);
    EXPECT_EQ(find(findings, c.what).fitness, c.fitness) << c.what;
    EXPECT_NE(find(findings, c.what).change, "") << c.what;
    EXPECT_EQ(fit_for_real_time(findings), c.fitness != Fitness::unfit) << c.what;
    for (const auto& finding : findings)
      EXPECT_TRUE(finding.what == c.what || finding.fitness == Fitness::fit) << finding.what << " with " << c.what;
  }
}

TEST(Check, ReadsTheKernelsFiles) {
  namespace fs = std::filesystem;
  const fs::path root = fs::path(testing::TempDir()) / "feedtwin-check";
  fs::remove_all(root);
  const auto write = [&](const std::string& path, const std::string& text) {
    fs::create_directories((root / path).parent_path());
    std::ofstream(root / path) << text;
  };
  write("proc/sys/kernel/sched_rt_runtime_us", "950000\n");
  write("proc/sys/kernel/sched_rt_period_us", "1000000\n");
  write("proc/cpuinfo", "processor : 0\nflags\t\t: fpu hypervisor lahf_lm\n");
  write("sys/devices/system/clocksource/clocksource0/current_clocksource", "hpet\n");
  write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n");
  write("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance\n");
  write("sys/devices/system/cpu/isolated", "1\n");
  write("sys/devices/system/cpu/nohz_full", "(null)\n");
  write("sys/class/net/eth0/type", "1\n");
  write("sys/class/net/vcan0/type", "280\n");
  write("dev/gpiochip0", "");
  const HostFacts facts = read_host_facts(root.string());
  EXPECT_EQ(facts.rt_runtime_us, 950'000);
  EXPECT_EQ(facts.rt_period_us, 1'000'000);
  EXPECT_TRUE(facts.virtual_machine);
  EXPECT_EQ(facts.clock_source, "hpet");
  EXPECT_EQ(facts.governors, (std::vector<std::string>{"powersave", "performance"}));
  EXPECT_EQ(facts.isolated, "1");
  EXPECT_EQ(facts.nohz_full, "");
  EXPECT_EQ(facts.can_interfaces, std::vector<std::string>{"vcan0"});
  EXPECT_EQ(facts.gpio_chips, std::vector<std::string>{"gpiochip0"});
  EXPECT_FALSE(facts.cpu_latency_writable);
  fs::remove_all(root);
}

TEST(Check, ThisHostCanBeRead) {
  const HostFacts facts = read_host_facts();
  EXPECT_NE(facts.kernel, "");
  EXPECT_GT(facts.cpus, 0);
}

}  // namespace
}  // namespace feedtwin::tools
