#include "tools/identify/rests.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::tools {
namespace {

constexpr std::size_t shortest_sticking = 8, rows_beside = 10;

}  // namespace

std::vector<Rest> rests_of(std::span<const double> position_m, std::size_t shortest) {
  std::vector<Rest> rests;
  for (std::size_t first = 0; first < position_m.size();) {
    std::size_t end = first + 1;
    while (end < position_m.size() && position_m[end] == position_m[first]) ++end;
    if (end - first >= shortest) rests.push_back({first, end});
    first = end;
  }
  return rests;
}

std::vector<double> reading_weights(std::span<const double> position_m) {
  std::vector<double> weights(position_m.size(), 1.0);
  for (const Rest& rest : rests_of(position_m, 1))
    for (std::size_t i = rest.first; i < rest.end; ++i)
      weights[i] = 1.0 / std::sqrt(static_cast<double>(rest.end - rest.first));
  return weights;
}

std::vector<bool> rows_near_rests(std::span<const double> position_m) {
  std::vector<bool> near(position_m.size(), false);
  for (const Rest& rest : rests_of(position_m, shortest_sticking)) {
    const std::size_t first = rest.first - std::min(rest.first, rows_beside),
                      end = std::min(rest.end + rows_beside, near.size());
    std::fill(near.begin() + static_cast<std::ptrdiff_t>(first), near.begin() + static_cast<std::ptrdiff_t>(end), true);
  }
  return near;
}

double mean_over(const std::vector<double>& values, const Rest& rest) {
  double sum = 0.0;
  for (std::size_t i = rest.first; i < rest.end; ++i) sum += values[i];
  return sum / static_cast<double>(rest.end - rest.first);
}

}  // namespace feedtwin::tools
