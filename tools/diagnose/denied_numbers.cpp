#include "tools/diagnose/denied_numbers.h"

#include <algorithm>
#include <utility>

#include "tools/diagnose/denied.h"
#include "tools/diagnose/verdict.h"

namespace feedtwin::tools::diagnosis {
namespace {

double times_the_files(const Diagnosis& result) {
  return times_as_far_off(result.holdout, &ChannelFigures::before);
}

/// A part that rings stands in the updated axis, and its mass is fitted beside the numbers.
bool rests_on_the_numbers(const Diagnosis& result) {
  const auto by_force = [](const NamedEffect& one) { return rests_on_force(*one.hypothesis); };
  return (result.unknown && result.unknown->mode) || std::ranges::any_of(result.effects, by_force);
}

}  // namespace

bool numbers_are_denied(const Diagnosis& result) {
  return !rests_on_the_numbers(result) && times_the_files(result) > numbers_of_harm_ratio;
}

bool numbers_stand_for_the_unknown(const Diagnosis& result) {
  const auto bent = [](const auto& channel) {
    const ChannelFigures& error = channel.second;
    return error.after > bent_channel_ratio * error.before && error.after > beyond_noise_ratio * error.floor;
  };
  return result.effects.empty() && result.setup.empty() && times_the_files(result) > bent_ratio &&
         std::ranges::any_of(result.holdout, bent);
}

void take_the_files_numbers(Diagnosis& result, plant::AxisParameters axis) {
  result.numbers_denied_by_unseen = times_the_files(result);
  result.recalibrated.clear();
  result.motor_presliding_m = 0.0;
  result.updated = std::move(axis);
  if (result.unknown_reading) result.unknown_reading->in_plant = false;
  if (result.verdict != "unknown") result.verdict = verdict_of(result);
}

bool still_denied(const Diagnosis& result) {
  return times_the_files(result) >= result.numbers_denied_by_unseen;
}

Candidate only_told(Candidate model, const std::vector<NamedEffect>& named) {
  std::erase_if(model.effects, [&](const Active& one) {
    return std::ranges::find(named, one.hypothesis, &NamedEffect::hypothesis) == named.end();
  });
  return model;
}

}  // namespace feedtwin::tools::diagnosis
