#include "tools/identify/lanes/dispatch.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <thread>

namespace feedtwin::tools::lanes {
namespace {

/// Scratch of one group of lanes, sample by sample, and its way back to one candidate at a time.
class Group {
 public:
  Group(const RecordView& record, const KernelEntry& kernel, const Wanted& wanted) : record_(record), kernel_(kernel) {
    const std::size_t size = record.samples * kernel.width;
    const auto reserve = [size](bool want, std::vector<double>& into) { into.resize(want ? size : 0); };
    reserve(wanted.torque, torque_);
    reserve(wanted.position, position_);
    reserve(wanted.torque_sensor, torque_sensor_);
    reserve(wanted.force_sensor, force_sensor_);
    reserve(wanted.power, power_);
  }

  /// Lanes beyond the candidates repeat the last one.
  void run(std::span<const Candidate> candidates, std::span<CandidateResult> results) {
    std::vector<Candidate> lanes(candidates.begin(), candidates.end());
    lanes.resize(kernel_.width, candidates.back());
    const auto pointer = [](std::vector<double>& from) { return from.empty() ? nullptr : from.data(); };
    kernel_.run(record_, lanes.data(),
                {kernel_.width, pointer(torque_), pointer(position_), pointer(torque_sensor_), pointer(force_sensor_),
                 pointer(power_)});
    for (std::size_t lane = 0; lane < candidates.size(); ++lane) {
      CandidateResult& result = results[lane];
      take(torque_, lane, result.torque_Nm);
      take(position_, lane, result.position_m);
      take(torque_sensor_, lane, result.torque_sensor_Nm);
      take(force_sensor_, lane, result.force_sensor_N);
      take(power_, lane, result.power_W);
    }
  }

 private:
  void take(const std::vector<double>& from, std::size_t lane, std::vector<double>& to) const {
    if (from.empty()) return;
    to.resize(record_.samples);
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i * kernel_.width + lane];
  }

  const RecordView& record_;
  const KernelEntry& kernel_;
  std::vector<double> torque_, position_, torque_sensor_, force_sensor_, power_;
};

std::atomic<std::size_t> widest_allowed{std::numeric_limits<std::size_t>::max()};

}  // namespace

void use_no_wider_than(std::size_t width) noexcept {
  widest_allowed = width;
}

std::vector<KernelEntry> usable_kernels() {
  std::vector<KernelEntry> usable{baseline_kernel()};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) usable.push_back(avx2_kernel());
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw")) {
    usable.push_back(avx512_kernel());
  }
#endif
  return usable;
}

KernelEntry best_kernel() {
  const auto kernels = usable_kernels();
  const auto fits = std::ranges::find_if(kernels.rbegin(), kernels.rend(),
                                         [](const KernelEntry& kernel) { return kernel.width <= widest_allowed.load(); });
  return fits == kernels.rend() ? kernels.front() : *fits;
}

std::vector<CandidateResult> simulate_candidates(const RecordView& record, std::span<const Candidate> candidates,
                                                 const Wanted& wanted, unsigned threads) {
  const KernelEntry kernel = best_kernel();
  std::vector<CandidateResult> results(candidates.size());
  const std::size_t groups = (candidates.size() + kernel.width - 1) / kernel.width;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    Group group(record, kernel, wanted);
    for (std::size_t g = next++; g < groups; g = next++) {
      const std::size_t first = g * kernel.width, count = std::min(kernel.width, candidates.size() - first);
      group.run(candidates.subspan(first, count), std::span(results).subspan(first, count));
    }
  };
  const std::size_t cores =
      std::min<std::size_t>(threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency()), groups);
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < cores; ++i) others.emplace_back(work);
  if (groups > 0) work();
  return results;
}

}  // namespace feedtwin::tools::lanes
