#include "tools/diagnose/forward/most_of_the_way.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/verdict.h"

namespace feedtwin::tools::diagnosis {

double share_of_the_way(const Nrmse& without, const Nrmse& with, const Nrmse& floor) {
  constexpr double beyond_noise = 2.0;
  double sum = 0.0, channels = 0.0;
  for (const auto& [channel, error] : without) {
    if (error <= beyond_noise * floor.at(channel)) continue;
    sum += (error - with.at(channel)) / (error - floor.at(channel));
    channels += 1.0;
  }
  return channels > 0.0 ? sum / channels : 0.0;
}

bool names_go_most_of_the_way(const ForwardModel& forward, const Fitter& fitter, const Candidate& numbers,
                              const Candidate& named, const std::function<void(std::string_view)>& progress) {
  constexpr double most = 0.45;
  if (names_no_force(named) || forward.spent()) return false;
  const auto alone = extended(polished_if_closer(forward, fitter, numbers)),
             together = extended(polished_if_closer(forward, fitter, named));
  const double share = share_of_the_way(forward.nrmse(alone), forward.nrmse(together), forward.noise_floor(together));
  progress(
      fmt::format("closed loop: the names go {:.0f} % of the way from the recalibrated numbers to noise", 100.0 * share));
  return share > most;
}

/// The meter's own noise is learned later: a force shows in the others.
double times_noise(const Nrmse& error, const Nrmse& floor) {
  double most = 0.0;
  for (const auto& [channel, value] : error)
    if (channel != channel::power_W && floor.at(channel) > 0.0) most = std::max(most, value / floor.at(channel));
  return most;
}

bool numbers_reach_noise(const ForwardModel& forward, const Fitter& fitter, const Candidate& numbers,
                         const std::function<void(std::string_view)>& progress) {
  constexpr double about_noise = 2.5;
  if (forward.spent()) return false;
  const auto alone = extended(polished_if_closer(forward, fitter, numbers));
  const double most = times_noise(forward.nrmse(alone), forward.noise_floor(alone));
  progress(fmt::format(
      "closed loop: with the recalibrated numbers alone no channel is off by more than {:.1f} times its noise", most));
  return most < about_noise;
}

Candidate beside_the_names(const Fitter& fitter, const SearchResult& found, const Candidate& model) {
  Candidate rest = model;
  std::erase_if(rest.effects, [&](const Active& active) {
    return worth_naming(active, model.axis) && rests_on_force(*active.hypothesis);
  });
  if (rest.effects.empty()) return found.recalibrated.model;
  return fitter.fit(rest, found.whitening, refit_iterations).model;
}

bool is_unknown(const ForwardModel& forward, const Fitter& fitter, const SearchResult& found, const Candidate& model,
                const std::function<void(std::string_view)>& progress) {
  if (!beyond_the_catalogue(fitter, found, model, progress)) return false;
  if (names_no_force(model)) return !numbers_reach_noise(forward, fitter, found.recalibrated.model, progress);
  return !names_go_most_of_the_way(forward, fitter, beside_the_names(fitter, found, model), model, progress);
}

}  // namespace feedtwin::tools::diagnosis
