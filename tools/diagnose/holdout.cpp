#include "tools/diagnose/holdout.h"

#include <algorithm>

namespace feedtwin::tools::diagnosis {

std::map<std::string, ChannelFigures> figures(const Followed& nominal, const Followed& recalibrated_only,
                                              const Followed& final) {
  std::map<std::string, ChannelFigures> out;
  const auto before = nrmse(nominal), middle = nrmse(recalibrated_only), after = nrmse(final);
  const auto floor = noise_floor(final), by_effects = made_by_effects(final);
  for (const auto& [channel, value] : before) {
    const auto at = [&channel](const Nrmse& all) { return all.contains(channel) ? all.at(channel) : 0.0; };
    out[channel] = {value, at(middle), at(after), at(floor), at(by_effects)};
  }
  return out;
}

ChannelFigures force_errors(const Followed& nominal, const Followed& recalibrated_only, const Followed& final) {
  return {relative_force_error(nominal), relative_force_error(recalibrated_only), relative_force_error(final)};
}

std::map<std::string, ChannelFigures> figures(const ForwardModel& runs, const AxisByRun& nominal,
                                              const AxisByRun& recalibrated_only, const AxisByRun& final) {
  std::map<std::string, ChannelFigures> out;
  const auto before = runs.nrmse(nominal), middle = runs.nrmse(recalibrated_only), after = runs.nrmse(final);
  const auto floor = runs.noise_floor(final);
  for (const auto& [channel, value] : before)
    // an estimate above what was reached is no floor
    out[channel] = {value, middle.at(channel), after.at(channel), std::min(floor.at(channel), after.at(channel))};
  return out;
}

}  // namespace feedtwin::tools::diagnosis
