#include "tools/diagnose/forward/closest.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/likelihood.h"
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

bool is_far_worse(double rival, double named, double repeated, double far_worse) {
  return rival > far_worse * std::clamp(repeated, named, far_worse * named);
}

bool spoils_a_channel(const ForwardModel& forward, const Candidate& rival, const Candidate& named, double far_worse) {
  const Nrmse by_rival = forward.nrmse(extended(rival)), by_named = forward.nrmse(extended(named));
  const auto farther_than = [&](const Nrmse& repeated) {
    return std::ranges::any_of(by_rival, [&](const auto& of) {
      return is_far_worse(of.second, by_named.at(of.first), repeated.at(of.first), far_worse);
    });
  };
  return farther_than(by_named) && farther_than(forward.noise_floor(extended(named)));
}

bool is_far_behind(const ForwardModel& forward, const Candidate& behind, const Candidate& ahead) {
  constexpr double far = 2.0;
  const auto of_behind = forward.nrmse(extended(behind)), of_ahead = forward.nrmse(extended(ahead));
  return std::ranges::any_of(of_behind, [&](const auto& of) { return of.second > far * of_ahead.at(of.first); });
}

bool is_better(const ForwardModel& forward, const Candidate& polished, const Candidate& before) {
  constexpr double surely_deviations = 3.0;
  if (spoils_a_channel(forward, polished, before, far_worse_polished)) return false;
  auto ways = ways_of(polished);
  const std::size_t of_polished = ways.size();
  for (auto& unpolished : ways_of(before)) ways.push_back(std::move(unpolished));
  if (closest(forward, ways) < of_polished) return true;
  return compared(likelihood(forward, extended(polished)), likelihood(forward, extended(before))).deviations >=
         surely_deviations;
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
