#include "tools/diagnose/forward/second_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/ruling.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr int iterations = 6;
constexpr std::size_t most_asked = 4;
constexpr double least_gain = 50.0;                     // by the inverse model
constexpr double beyond_noise = 2.0;                    // a channel that is worth the question
constexpr double least_ratio = 1.5, least_share = 0.5;  // of a channel's error; of what is beyond noise
constexpr double least_nats = 100.0, least_deviations = 3.0;

/// How a model brings a channel closer, of those that are off beyond noise.
struct Closer {
  std::string channel;
  double ratio = 1.0, share = 0.0;
};

Closer closer(const Nrmse& before, const Nrmse& after, const Nrmse& floor, bool only_readings) {
  Closer best;
  for (const auto& [name, error] : before) {
    const bool reading = name == channel::torque_sensor_Nm || name == channel::force_sensor_N;
    if (error < beyond_noise * floor.at(name) || (only_readings && !reading)) continue;
    const double ratio = error / std::max(after.at(name), 1e-12);
    if (ratio > best.ratio) best = {name, ratio, (error - after.at(name)) / (error - floor.at(name))};
  }
  return best;
}

bool can_be_asked(const Score& score, const Candidate& model) {
  const Hypothesis& h = *score.hypothesis;
  // what acts at reversals is also what one bristle cannot do of any friction
  return !has(model, h) && !h.about_reversals && score.gain > least_gain;
}

}  // namespace

Candidate look_again(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                     const Candidate& settled, const std::function<void(std::string_view)>& progress) {
  std::vector<Score> asked;
  for (const auto& score : found.last.scores)
    if (can_be_asked(score, fit.model) && asked.size() < most_asked) asked.push_back(score);
  if (asked.empty()) return settled;
  const auto floor = forward.noise_floor(extended(settled));
  const auto is_off = [&](const Nrmse& errors) {
    return std::ranges::any_of(errors, [&](const auto& e) { return e.second > beyond_noise * floor.at(e.first); });
  };
  if (!is_off(forward.nrmse(extended(settled)))) return settled;
  const Ruling now = found.found.empty() ? rule(fit, forward, fitter) : rule_again(fit, settled, forward, fitter);
  const Nrmse errors = forward.nrmse(extended(now.model));
  if (!is_off(errors)) return now.model;
  std::optional<Ruling> best;
  const Score* better = nullptr;
  for (const auto& score : asked) {
    const Fit with = fit_with(fitter, fit.model, score, fit.model.effects.size(), found.whitening, iterations);
    if (!can_be_named(with.model.effects.back(), with.model.axis)) continue;
    Ruling one = rule_beside(now, with, forward, fitter);
    if (!can_be_named(one.model.effects.back(), one.model.axis)) continue;
    const auto seen = closer(errors, forward.nrmse(extended(one.model)), floor, score.hypothesis->only_readings);
    const auto difference = compared(one.likelihood, now.likelihood);
    progress(fmt::format("closed loop, with {}: {:+.0f} nats, {:+.1f} deviations, {} {:.2f} times as close, {:.0f} %",
                         score.hypothesis->id, one.value - now.value, difference.deviations,
                         seen.channel.empty() ? "no channel" : seen.channel, seen.ratio, 100.0 * seen.share));
    if (seen.ratio < least_ratio || seen.share < least_share || one.value - now.value < least_nats ||
        difference.deviations < least_deviations || (best && best->value > one.value))
      continue;
    best = std::move(one), better = &score;
  }
  if (!best) return now.model;
  const Active& effect = best->model.effects.back();
  found.found.push_back({.effect = effect,
                         .gain = fit.cost - best->fit.cost,
                         .share = std::clamp((fit.cost - best->fit.cost) / std::max(1.0, better->touched), 0.0, 1.0),
                         .strength = 0.0,
                         .p_false_alarm = found.last.p_false_alarm(better->standard),
                         .rivals = {},
                         .held_everywhere = false});
  fit = best->fit;
  return best->model;
}

}  // namespace feedtwin::tools::diagnosis
