#include "tools/diagnose/forward/closest.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/polish.h"

namespace feedtwin::tools::diagnosis {

double far_off(const ForwardModel& forward, const AxisByRun& axis) {
  double sum = 0.0;
  const Nrmse all = forward.nrmse(axis);
  for (const auto& [channel, error] : all) sum += std::log(std::max(1e-12, error));
  return sum / static_cast<double>(std::max<std::size_t>(1, all.size()));
}

std::size_t closest(const ForwardModel& forward, const std::vector<AxisByRun>& axes) {
  constexpr double clearly = 0.01;
  std::size_t best = 0;
  double least = far_off(forward, axes[0]) - clearly;
  for (std::size_t i = 1; i < axes.size(); ++i) {
    const double error = far_off(forward, axes[i]);
    if (error < least) best = i, least = error;
  }
  return best;
}

Candidate polished_if_closer(const ForwardModel& forward, const Fitter& fitter, const Candidate& start) {
  PolishSettings quick;
  quick.rounds = 1;
  quick.coloured_from_start = true;
  quick.intervals = false;
  const Candidate polished = polish(forward, fitter, start, quick).model;
  return closest(forward, {extended(polished), extended(start)}) == 0 ? polished : start;
}

}  // namespace feedtwin::tools::diagnosis
