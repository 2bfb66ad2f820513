#include "tools/check/findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace feedtwin::tools {
namespace {

constexpr int wanted_priority = 80;  // what serve asks for
constexpr double wanted_lock_MiB = 256;

Finding kernel(const HostFacts& f) {
  if (f.real_time_kernel) return {"kernel", f.kernel, Fitness::fit, ""};
  return {"kernel", f.kernel, Fitness::unfit, "not PREEMPT_RT: apt install linux-image-rt-amd64, and boot it"};
}

Finding scheduler(const HostFacts& f) {
  const auto found = fmt::format("SCHED_FIFO up to {}", f.priority_limit);
  if (f.priority_limit >= wanted_priority) return {"scheduler rights", found, Fitness::fit, ""};
  return {
      "scheduler rights", f.priority_limit > 0 ? found : "no real-time priority", Fitness::unfit,
      fmt::format("\"@realtime - rtprio {}\" in /etc/security/limits.d, be in that group and log in again; or run as root",
                  wanted_priority)};
}

Finding throttling(const HostFacts& f) {
  if (f.rt_runtime_us < 0) return {"real-time share", "all of the time", Fitness::fit, ""};
  return {"real-time share", fmt::format("{} of {} us", f.rt_runtime_us, f.rt_period_us), Fitness::improvable,
          "matters only to a loop that is nearly always busy: sysctl kernel.sched_rt_runtime_us=-1"};
}

Finding memory(const HostFacts& f) {
  if (f.memory_lock_unlimited) return {"memory locking", "unlimited", Fitness::fit, ""};
  const auto found = fmt::format("{:.0f} MiB", f.memory_lock_MiB);
  if (f.memory_lock_MiB >= wanted_lock_MiB) return {"memory locking", found, Fitness::fit, ""};
  return {"memory locking", found, Fitness::unfit,
          "\"@realtime - memlock unlimited\" in /etc/security/limits.d; or run as root"};
}

Finding idle_states(const HostFacts& f) {
  if (f.cpu_latency_writable) return {"idle states", "/dev/cpu_dma_latency may be held", Fitness::fit, ""};
  return {"idle states", "/dev/cpu_dma_latency can't be written", Fitness::improvable,
          "a udev rule that gives it to the realtime group, or run as root; else wake-ups from deep sleep take longer"};
}

Finding clock(const HostFacts& f) {
  constexpr std::array good{"tsc", "arch_sys_counter", "kvm-clock", "hyperv_clocksource_tsc_page"};
  if (std::ranges::find(good, f.clock_source) != good.end()) return {"clock source", f.clock_source, Fitness::fit, ""};
  return {"clock source", f.clock_source.empty() ? "unknown" : f.clock_source, Fitness::improvable,
          "every look at the clock enters the kernel; try tsc (kernel parameter tsc=reliable, if it is)"};
}

Finding governor(const HostFacts& f) {
  if (f.governors.empty()) return {"frequency governor", "none", Fitness::fit, ""};
  const auto other = std::ranges::find_if(f.governors, [](const auto& g) { return g != "performance"; });
  if (other == f.governors.end()) return {"frequency governor", "performance", Fitness::fit, ""};
  return {"frequency governor", *other, Fitness::improvable, "cpupower frequency-set -g performance"};
}

Finding isolation(const HostFacts& f) {
  if (f.cpus < 2) {
    return {"processors", fmt::format("{}", f.cpus), Fitness::improvable,
            "a second one would keep other work off the loop's"};
  }
  if (!f.isolated.empty()) {
    return {"processors",
            f.nohz_full.empty() ? fmt::format("{}, isolated: {}", f.cpus, f.isolated)
                                : fmt::format("{}, isolated: {}, without tick: {}", f.cpus, f.isolated, f.nohz_full),
            Fitness::fit, ""};
  }
  return {"processors", fmt::format("{}, none isolated", f.cpus), Fitness::improvable,
          fmt::format("kernel parameters isolcpus={0} nohz_full={0} rcu_nocbs={0}, and server.cpu = {0}", f.cpus - 1)};
}

Finding machine(const HostFacts& f) {
  if (!f.virtual_machine) return {"machine", "real", Fitness::fit, ""};
  return {"machine", "virtual", Fitness::improvable,
          "its host may stop it for milliseconds, which nothing in here can prevent"};
}

Finding can(const HostFacts& f) {
  if (!f.can_interfaces.empty()) return {"CAN", fmt::format("{}", fmt::join(f.can_interfaces, ", ")), Fitness::fit, ""};
  if (f.can_sockets) {
    return {"CAN", "no interface", Fitness::improvable, "only for the can port: ip link add can0 type vcan, or an adapter"};
  }
  return {"CAN", "the kernel has no CAN sockets", Fitness::improvable, "only for the can port: modprobe can can-raw vcan"};
}

Finding gpio(const HostFacts& f) {
  if (!f.gpio_chips.empty()) return {"GPIO", fmt::format("{}", fmt::join(f.gpio_chips, ", ")), Fitness::fit, ""};
  return {"GPIO", "no chip", Fitness::improvable,
          "only for the gpio port: a board or adapter with lines under /dev/gpiochip*"};
}

}  // namespace

std::vector<Finding> findings_on(const HostFacts& f) {
  return {kernel(f),   scheduler(f), throttling(f), memory(f), idle_states(f), clock(f),
          governor(f), isolation(f), machine(f),    can(f),    gpio(f)};
}

bool fit_for_real_time(const std::vector<Finding>& findings) {
  return std::ranges::none_of(findings, [](const Finding& f) { return f.fitness == Fitness::unfit; });
}

}  // namespace feedtwin::tools
