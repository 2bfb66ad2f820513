#include "tools/check/host_facts.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/descriptor.h"

namespace feedtwin::tools {
namespace {

namespace fs = std::filesystem;

constexpr int arphrd_can = 280;                      // linux/if_arp.h
constexpr int cap_ipc_lock = 14, cap_sys_nice = 23;  // linux/capability.h

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (!line.empty() && (line.back() == ' ' || line.back() == '\n')) line.pop_back();
  return line;
}

long long number(const std::string& text, long long preset) {
  long long value = preset;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

bool has_capability(const fs::path& status, int capability) {
  std::ifstream file(status);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("CapEff:")) return (std::stoull(line.substr(7), nullptr, 16) >> capability & 1U) != 0;
  }
  return false;
}

std::vector<std::string> names_in(const fs::path& folder, const std::string& prefix) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().starts_with(prefix)) names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

void read_kernel(const fs::path& root, HostFacts& facts) {
  utsname name{};
  uname(&name);
  facts.kernel = std::string(name.release) + " " + name.version;
  facts.real_time_kernel =
      facts.kernel.find("PREEMPT_RT") != std::string::npos && first_line(root / "sys/kernel/realtime") == "1";
  facts.rt_runtime_us = number(first_line(root / "proc/sys/kernel/sched_rt_runtime_us"), -1);
  facts.rt_period_us = number(first_line(root / "proc/sys/kernel/sched_rt_period_us"), -1);
  facts.clock_source = first_line(root / "sys/devices/system/clocksource/clocksource0/current_clocksource");
}

void read_rights(const fs::path& root, HostFacts& facts) {
  const fs::path status = root / "proc/self/status";
  rlimit limit{};
  getrlimit(RLIMIT_RTPRIO, &limit);
  const int highest = sched_get_priority_max(SCHED_FIFO);
  facts.priority_limit = has_capability(status, cap_sys_nice)
                             ? highest
                             : static_cast<int>(std::min<rlim_t>(limit.rlim_cur, static_cast<rlim_t>(highest)));
  getrlimit(RLIMIT_MEMLOCK, &limit);
  facts.memory_lock_unlimited = limit.rlim_cur == RLIM_INFINITY || has_capability(status, cap_ipc_lock);
  facts.memory_lock_MiB = static_cast<double>(limit.rlim_cur) / (1024.0 * 1024.0);
  facts.cpu_latency_writable = access((root / "dev/cpu_dma_latency").c_str(), W_OK) == 0;
}

void read_processors(const fs::path& root, HostFacts& facts) {
  const fs::path folder = root / "sys/devices/system/cpu";
  facts.cpus = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  for (const auto& cpu : names_in(folder, "cpu")) {
    const auto governor = first_line(folder / cpu / "cpufreq/scaling_governor");
    if (!governor.empty()) facts.governors.push_back(governor);
  }
  facts.isolated = first_line(folder / "isolated");
  facts.nohz_full = first_line(folder / "nohz_full");
  if (facts.nohz_full == "(null)") facts.nohz_full.clear();
  std::ifstream info(root / "proc/cpuinfo");
  for (std::string line; std::getline(info, line) && !facts.virtual_machine;) {
    facts.virtual_machine = line.starts_with("flags") && line.find(" hypervisor") != std::string::npos;
  }
}

void read_devices(const fs::path& root, HostFacts& facts) {
  const fs::path folder = root / "sys/class/net";
  for (const auto& name : names_in(folder, "")) {
    if (number(first_line(folder / name / "type"), 0) == arphrd_can) facts.can_interfaces.push_back(name);
  }
  facts.can_sockets = static_cast<bool>(io::Descriptor(::socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, 1)));
  facts.gpio_chips = names_in(root / "dev", "gpiochip");
}

}  // namespace

HostFacts read_host_facts(const std::string& root) {
  const fs::path base = root.empty() ? "/" : root;
  HostFacts facts;
  read_kernel(base, facts);
  read_rights(base, facts);
  read_processors(base, facts);
  read_devices(base, facts);
  return facts;
}

}  // namespace feedtwin::tools
