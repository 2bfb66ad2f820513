#pragma once
// What this host is, as far as real time is concerned: read from the kernel's own files and from this process's rights.

#include <string>
#include <vector>

namespace feedtwin::tools {

struct HostFacts {
  std::string kernel;  ///< release and version, as uname gives them
  bool real_time_kernel = false;
  int priority_limit = 0;                           ///< highest SCHED_FIFO priority that this process may take
  long long rt_runtime_us = -1, rt_period_us = -1;  ///< share of time that real-time threads get; runtime -1: all of it
  bool memory_lock_unlimited = false;
  double memory_lock_MiB = 0.0;  ///< where it is limited
  bool cpu_latency_writable = false;
  std::string clock_source;
  int cpus = 0;
  std::vector<std::string> governors;  ///< of each processor that has one
  std::string isolated, nohz_full;     ///< lists of processors; empty: none
  bool virtual_machine = false;
  std::vector<std::string> can_interfaces, gpio_chips;
  bool can_sockets = false;  ///< the kernel knows the address family
};

/// @param root "" for this host; another folder holds the kernel's files for a test.
[[nodiscard]] HostFacts read_host_facts(const std::string& root = "");

}  // namespace feedtwin::tools
