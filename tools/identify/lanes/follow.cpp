#include "tools/identify/lanes/follow.h"

#include <algorithm>
#include <vector>

#include "tools/identify/lanes/dispatch.h"
#include "tools/parallel.h"

namespace feedtwin::tools::lanes {
namespace {

/// Half-empty registers cost as much as full ones: the narrowest that takes them all, or the widest there is.
KernelEntry kernel_for(std::size_t motions) {
  const KernelEntry best = best_kernel();
  const auto all = usable_kernels();
  const auto enough = std::ranges::find_if(
      all, [&](const KernelEntry& kernel) { return kernel.width >= motions && kernel.width <= best.width; });
  return enough == all.end() ? best : *enough;
}

}  // namespace

void follow_friction(std::span<const FollowedMotion> motions) {
  if (motions.empty()) return;
  const KernelEntry kernel = kernel_for(motions.size());
  parallel_for((motions.size() + kernel.width - 1) / kernel.width, [&](std::size_t group) {
    const auto own = motions.subspan(group * kernel.width, std::min(kernel.width, motions.size() - group * kernel.width));
    std::vector<FollowedMotion> lanes(own.begin(), own.end());
    lanes.resize(kernel.width, own.back());  // empty lanes follow the last one again
    kernel.follow(lanes.data());
  });
}

}  // namespace feedtwin::tools::lanes
