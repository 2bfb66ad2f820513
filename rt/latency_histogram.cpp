#include "rt/latency_histogram.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::rt {

std::uint64_t LatencyHistogram::upper_edge(std::size_t index) noexcept {
  constexpr std::size_t linear = 1U << sub_bits;
  if (index < linear) return index;
  const auto shift = (index >> sub_bits) - 1;
  return (((index & (linear - 1)) + linear + 1) << shift) - 1;
}

double LatencyHistogram::percentile_us(double share) const noexcept {
  if (total_ == 0) return 0.0;
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(total_)));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < buckets; ++i) {
    seen += counts_[i];
    if (seen >= wanted && seen > 0) {
      const auto edge = static_cast<std::int64_t>(upper_edge(i));
      return static_cast<double>(std::min(edge, max_ns_)) * 1e-3;
    }
  }
  return static_cast<double>(max_ns_) * 1e-3;
}

}  // namespace feedtwin::rt
