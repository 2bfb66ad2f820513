#include "tools/identify/setpoint.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "plant/effects/registry.h"

namespace feedtwin::tools {
namespace {

/// From the rows before and after; over some more where that is no more than a grid.
std::vector<double> velocity_of(std::span<const double> position_m, std::optional<double> grid_m, double tick_s) {
  constexpr std::size_t near = 1, far = 5;
  std::vector<double> all(position_m.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const std::size_t beside : {near, far}) {
      const std::size_t from = i < beside ? 0 : i - beside, to = std::min(i + beside, all.size() - 1);
      const double moved_m = position_m[to] - position_m[from];
      all[i] = moved_m / (static_cast<double>(to - from) * tick_s);
      if (!grid_m || std::abs(moved_m) > 1.5 * *grid_m) break;
    }
  return all;
}

Setpoint with_slope(std::vector<double> v, double tick_s) {
  constexpr double about_s = 0.01;
  Setpoint setpoint{std::move(v), {}};
  const auto& all = setpoint.velocity_m_per_s;
  const auto about = static_cast<std::size_t>(std::max(1.0, std::round(about_s / tick_s)));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t from = i < about ? 0 : i - about, to = std::min(i + about, all.size() - 1);
    setpoint.slope_m_per_s2.push_back((all[to] - all[from]) / (static_cast<double>(to - from) * tick_s));
  }
  return setpoint;
}

}  // namespace

Setpoints setpoints_of(const Recording& recording, double count_m) {
  const double tick_s = recording.sample_s;
  Setpoints all{with_slope(velocity_of(recording.at(channel::position_m), count_m, tick_s), tick_s), {}};
  if (recording.has(channel::reference_m))
    all.of_reference = with_slope(velocity_of(recording.at(channel::reference_m), std::nullopt, tick_s), tick_s);
  return all;
}

SetpointSource setpoint_source(const plant::AxisParameters& axis) {
  constexpr std::string_view id = "hidden_friction_compensation";
  const auto effect = std::ranges::find(axis.effects, id, &plant::EffectSetting::id);
  if (effect == axis.effects.end()) return {};
  plant::EffectSetting copy = *effect;
  const auto value = [&](std::string_view name) { return *plant::value_in(copy, *plant::find_effect(id), name); };
  return {value("lead_s"), value("of_motion") > 0.5};
}

}  // namespace feedtwin::tools
