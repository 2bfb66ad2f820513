#include "tools/diagnose/holdout.h"

#include <algorithm>

namespace feedtwin::tools::diagnosis {

std::map<std::string, ChannelFigures> figures(const InverseModel& runs, const Candidate& nominal,
                                              const Candidate& recalibrated_only, const Candidate& final) {
  std::map<std::string, ChannelFigures> out;
  const auto before = nrmse(runs, nominal), middle = nrmse(runs, recalibrated_only), after = nrmse(runs, final);
  const auto floor = noise_floor(runs, final);
  for (const auto& [channel, value] : before) {
    const auto at = [&channel](const Nrmse& all) { return all.contains(channel) ? all.at(channel) : 0.0; };
    out[channel] = {value, at(middle), at(after), at(floor)};
  }
  return out;
}

ChannelFigures force_errors(const InverseModel& runs, const Candidate& nominal, const Candidate& recalibrated_only,
                            const Candidate& final) {
  return {relative_force_error(runs, nominal), relative_force_error(runs, recalibrated_only),
          relative_force_error(runs, final)};
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
