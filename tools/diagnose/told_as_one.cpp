#include "tools/diagnose/told_as_one.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnose/sentence.h"

namespace feedtwin::tools::diagnosis {
namespace {

std::vector<NamedEffect>::iterator place_of(Diagnosis& result, std::string_view id) {
  return std::ranges::find(result.effects, &hypothesis(id), &NamedEffect::hypothesis);
}

/// Two or three times as often a revolution, less than half as large.
bool is_harmonic(const NamedEffect& one, const NamedEffect& of) {
  constexpr double least_share = 0.5, off_order = 1e-3;
  const double order = value_of(of, "cycles_per_rev"), times = value_of(one, "cycles_per_rev") / std::max(order, 1e-9);
  const bool multiple = std::abs(times - 2.0) < off_order || std::abs(times - 3.0) < off_order;
  const double size_m = value_of(one, "amplitude_m"), of_m = value_of(of, "amplitude_m");
  return multiple && size_m > 0.0 && size_m < least_share * of_m;
}

}  // namespace

void tell_as_one_lead(Diagnosis& result) {
  const auto mended = std::ranges::find(result.setup, "wrong_lead", &SetupFault::id);
  const auto left = place_of(result, "lead_error");
  if (mended == result.setup.end() || left == result.effects.end()) return;
  mended->parameters.front().value *= 1.0 + left->parameters.front().second.value;
  result.effects.erase(left);
}

void tell_as_one_wave(Diagnosis& result) {
  for (std::size_t i = 0; i < result.effects.size(); ++i)
    for (std::size_t k = 0; k < result.effects.size(); ++k) {
      auto &one = result.effects[k], &of = result.effects[i];
      if (i == k || !easily_confused(*one.hypothesis, *of.hypothesis) || !is_harmonic(one, of)) continue;
      of.sentence += fmt::format(" It is no pure sine: {:.3g} m come {:.0f} times a revolution, in the updated axis as {}.",
                                 value_of(one, "amplitude_m"), value_of(one, "cycles_per_rev"), one.hypothesis->id);
      result.effects.erase(result.effects.begin() + static_cast<std::ptrdiff_t>(k));
      return tell_as_one_wave(result);
    }
}

void tell_as_one_cogging(Diagnosis& result) {
  constexpr double off_order = 1e-3, off_phase_rad = 0.25, most_share = 0.4;
  const auto cogging = place_of(result, "cogging"), ripple = place_of(result, "torque_ripple");
  if (cogging == result.effects.end() || ripple == result.effects.end()) return;
  const auto apart = [&](std::string_view name) { return value_of(*cogging, name) - value_of(*ripple, name); };
  const bool a_quarter_away = std::abs(std::cos(apart("phase_rad"))) < std::sin(off_phase_rad);
  if (std::abs(apart("cycles_per_rev")) > off_order || !a_quarter_away || ripple->share > most_share * cogging->share)
    return;
  cogging->sentence +=
      " It comes later the harder the motor pulls, as what yields between shaft and encoder lets it: in the updated axis as "
      "torque_ripple.";
  result.effects.erase(ripple);
}

void tell_as_one_change(Diagnosis& result) {
  for (const auto& [first, second] :
       {std::pair{"thermal_friction", "thermal_friction_of_all"}, std::pair{"thermal_friction", "friction_drift"},
        std::pair{"thermal_friction_of_all", "friction_drift"}, std::pair{"frictional_lag", "frictional_lag_of_velocity"}}) {
    const auto one = place_of(result, first), other = place_of(result, second);
    if (one == result.effects.end() || other == result.effects.end()) continue;
    const auto &told = one->share >= other->share ? one : other, &beside = one->share >= other->share ? other : one;
    told->sentence +=
        fmt::format(" It follows that law roughly: the updated axis has {} beside it.", beside->hypothesis->id);
    result.effects.erase(beside);
  }
}

void tell_as_one_friction_along(Diagnosis& result) {
  const auto wave = place_of(result, "position_friction_wave"), slope = place_of(result, "position_friction");
  if (wave == result.effects.end() || slope == result.effects.end()) return;
  const bool waves = wave->share >= slope->share;
  const auto &told = waves ? wave : slope, &other = waves ? slope : wave;
  told->sentence += waves ? " It grows along the stroke too." : " It goes up and down along the stroke too.";
  for (auto& parameter : other->parameters) told->parameters.push_back(std::move(parameter));
  result.effects.erase(other);
}

void tell_as_one_growth(Diagnosis& result, double run_s) {
  constexpr double most_before = 1.5;  // times what it grows by while it is recorded
  const auto growth = place_of(result, "screw_growth"), lead = place_of(result, "lead_error");
  if (growth == result.effects.end() || lead == result.effects.end()) return;
  const double grown =
      value_of(*growth, "relative_growth") * (1.0 - std::exp(-run_s / std::max(value_of(*growth, "time_constant_s"), 1e-9)));
  const double before = value_of(*lead, "relative_error");
  if (before * grown <= 0.0 || std::abs(before) > most_before * std::abs(grown)) return;
  growth->sentence += fmt::format(
      " It was warm when the runs began: {:.2g} of its length had grown before, in the updated "
      "axis as lead_error.",
      before);
  result.effects.erase(lead);
}

void tell_as_one(Diagnosis& result, double run_s) {
  tell_as_one_lead(result);
  tell_as_one_wave(result);
  tell_as_one_cogging(result);
  tell_as_one_change(result);
  tell_as_one_friction_along(result);
  tell_as_one_growth(result, run_s);
}

}  // namespace feedtwin::tools::diagnosis
