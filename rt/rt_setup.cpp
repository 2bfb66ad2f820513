#include "rt/rt_setup.h"

#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>

namespace feedtwin::rt {
namespace {

SettingReport report(std::string what, std::string asked, int error, const std::string& remedy) {
  if (error == 0) return {std::move(what), asked, asked, "", true};
  return {std::move(what), std::move(asked), "denied", std::string(std::strerror(error)) + "; " + remedy, false};
}

SettingReport lock_memory() {
  const int error = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? 0 : errno;
  return report("memory", "locked", error, "run as root, or LimitMEMLOCK=infinity (systemd), ulimit -l unlimited");
}

/// Touch heap pages once and keep them: no page fault and no trim later.
void prefault_heap(std::size_t bytes) {
  ::mallopt(M_TRIM_THRESHOLD, -1);
  ::mallopt(M_MMAP_MAX, 0);
  const auto block = std::make_unique<unsigned char[]>(bytes);
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  for (std::size_t i = 0; i < bytes; i += page) static_cast<volatile unsigned char*>(block.get())[i] = 1;
}

[[gnu::noinline]] void prefault_stack(std::size_t bytes) {
  constexpr std::size_t block_bytes = 16 * 1024;
  [[maybe_unused]] volatile unsigned char block[block_bytes];
  for (std::size_t i = 0; i < block_bytes; i += 1024) block[i] = 1;
  if (bytes > block_bytes) prefault_stack(bytes - block_bytes);
  block[0] = 2;  // after the call: no tail recursion, every frame is real
}

}  // namespace

RtProcess::RtProcess(const RtSettings& settings) {
  if (!settings.real_time) return;
  if (settings.lock_memory) reports_.push_back(lock_memory());
  prefault_heap(settings.prefault_heap_bytes);
  if (settings.hold_cpu_latency) {
    cpu_latency_fd_ = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
    const std::int32_t latency_us = 0;
    const bool held = cpu_latency_fd_ >= 0 && ::write(cpu_latency_fd_, &latency_us, sizeof latency_us) == sizeof latency_us;
    reports_.push_back(
        report("idle states", "0 us wake-up", held ? 0 : errno, "needs write access to /dev/cpu_dma_latency"));
  }
}

RtProcess::~RtProcess() {
  if (cpu_latency_fd_ >= 0) ::close(cpu_latency_fd_);
}

std::vector<SettingReport> make_thread_real_time(const RtSettings& settings) {
  std::vector<SettingReport> reports;
  if (!settings.real_time) return reports;
  prefault_stack(settings.prefault_stack_bytes);
  if (settings.cpu >= 0) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<unsigned>(settings.cpu), &set);
    const int error = ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set);
    reports.push_back(report("core", std::to_string(settings.cpu), error, "no such core, or not in this process's cpuset"));
  }
  if (settings.priority > 0) {
    const sched_param parameter{.sched_priority = settings.priority};
    const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameter);
    reports.push_back(report("scheduling", "SCHED_FIFO " + std::to_string(settings.priority), error,
                             "run as root, or LimitRTPRIO=99 (systemd), rtprio in /etc/security/limits.conf"));
  }
  return reports;
}

SettingReport kernel_report() {
  utsname name{};
  ::uname(&name);
  std::ifstream flag("/sys/kernel/realtime");
  int value = 0;
  const bool flagged = (flag >> value) && value == 1;
  const bool named = std::strstr(name.version, "PREEMPT_RT") != nullptr;
  SettingReport report{"kernel", "PREEMPT_RT", std::string(name.release) + (named ? " PREEMPT_RT" : ""), "",
                       named && flagged};
  if (!report.granted) report.why = "not a real-time kernel; install linux-image-rt-amd64 and boot it";
  return report;
}

}  // namespace feedtwin::rt
