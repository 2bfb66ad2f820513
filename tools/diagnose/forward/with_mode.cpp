#include "tools/diagnose/forward/with_mode.h"

#include <cmath>
#include <utility>

#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/extended_axis.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::string_view mode_id = "learned_mode";
constexpr double most_damping_ratio = 0.5;

Candidate with(Candidate model, const Mode& mode) {
  std::erase_if(model.axis.effects, [](const plant::EffectSetting& effect) { return effect.id == mode_id; });
  model.axis.effects.push_back({std::string(mode_id), {mode.mass_kg, mode.frequency_Hz, mode.damping_ratio}, {}});
  return model;
}

/// Along what the numbers are changed, in steps of their logarithms: a mass and a damping are known so much less well than a
/// frequency, and more of both swings as far.
struct Way {
  double frequency, mass, damping;
};
constexpr Way ways[] = {{1.0, 0.0, 0.0}, {0.0, 12.0, 0.0}, {0.0, 0.0, 25.0}, {0.0, 12.0, 12.0}};

Mode changed(const Mode& mode, const Way& way, double step) {
  return {mode.frequency_Hz * std::exp(way.frequency * step),
          std::min(most_damping_ratio, mode.damping_ratio * std::exp(way.damping * step)),
          mode.mass_kg * std::exp(way.mass * step)};
}

/// The lowest place of a cost near to where it starts, in steps that shrink.
template <class Cost>
Mode lowest(Mode at, double step, const Cost& cost) {
  constexpr int rounds = 2, most_steps = 4;
  double least = cost(at);
  for (int round = 0; round < rounds; ++round, step *= 0.4)
    for (const auto& way : ways)
      for (const double signed_step : {step, -step})
        for (int k = 0; k < most_steps; ++k) {
          const Mode next = changed(at, way, signed_step);
          const double found = cost(next);
          if (found >= least) break;
          at = next, least = found;
        }
  return at;
}

}  // namespace

plant::AxisParameters with_mode(const ForwardModel& forward, const Fitter& fitter, const Candidate& told, Learned& learned) {
  Mode mode = *std::exchange(learned.mode, std::nullopt);
  const Candidate plain = polished_if_closer(forward, fitter, told);
  const auto axis = [&](const Candidate& model) { return with_phases_of(told, extended(model, worth_naming).common); };
  if (mode.mass_kg <= 0.0) return extended(plain, worth_naming).common;
  Candidate more = plain;
  for (const double step : {0.02, 0.006, 0.002}) {
    mode = lowest(mode, step, [&](const Mode& tried) { return far_off(forward, axis(with(more, tried))); });
    more = polished_if_closer(forward, fitter, with(more, mode));
  }
  if (closest(forward, {axis(plain), axis(more)}) == 0) return extended(plain, worth_naming).common;
  learned.mode = mode;
  return extended(more, worth_naming).common;
}

}  // namespace feedtwin::tools::diagnosis
