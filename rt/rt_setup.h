#pragma once
// What real time asks of the host, and what the host gave: each setting with asked, got and why.
// Sources: Linux man-pages sched(7), mlockall(2), Documentation/admin-guide/pm/cpuidle (PM QoS, /dev/cpu_dma_latency).

#include <cstddef>
#include <string>
#include <vector>

namespace feedtwin::rt {

struct RtSettings {
  bool real_time = true;  ///< false: ask for nothing
  int priority = 80;      ///< SCHED_FIFO, 1..99; 0: leave the policy alone
  int cpu = -1;           ///< pin the tick to this core; -1: do not pin
  bool lock_memory = true;
  std::size_t prefault_stack_bytes = 256 * 1024;
  std::size_t prefault_heap_bytes = 8 * 1024 * 1024;
  bool hold_cpu_latency = true;  ///< keep cores out of deep idle states
};

struct SettingReport {
  std::string what, asked, got, why;  ///< `why` says what stood in the way and what to change; empty when granted
  bool granted = true;
};

/// Applies process-wide settings (memory, idle states) and holds them until destroyed. Set-up only.
class RtProcess {
 public:
  explicit RtProcess(const RtSettings& settings);
  RtProcess(const RtProcess&) = delete;
  RtProcess& operator=(const RtProcess&) = delete;
  ~RtProcess();
  [[nodiscard]] const std::vector<SettingReport>& reports() const noexcept { return reports_; }

 private:
  std::vector<SettingReport> reports_;
  int cpu_latency_fd_ = -1;
};

/// Applies the calling thread's own settings (policy, priority, core, stack). Set-up only.
[[nodiscard]] std::vector<SettingReport> make_thread_real_time(const RtSettings& settings);

/// Whether this kernel is built for real time: PREEMPT_RT in its version and /sys/kernel/realtime, as LinuxCNC asks too.
[[nodiscard]] SettingReport kernel_report();

}  // namespace feedtwin::rt
