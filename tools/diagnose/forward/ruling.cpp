#include "tools/diagnose/forward/ruling.h"

#include <algorithm>
#include <utility>

#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/polish.h"
#include "tools/diagnose/forward/rulings_before.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double nats_per_parameter = 4.0;
constexpr double hopeless_nats = 1500.0;  // behind another: who is nearer is polished to the end

double freedom(const Candidate& model) {
  double count = 0.0;
  for (const auto& effect : model.effects) count += static_cast<double>(freedom(*effect.hypothesis));
  return count;
}

/// The model with all numbers that the other has too as the other has them.
Candidate with_numbers_of(const Candidate& other, Candidate model) {
  auto own_effects = std::move(model.axis.effects);
  model.axis = other.axis;
  model.axis.effects = std::move(own_effects);
  for (auto& effect : model.effects)
    for (const auto& theirs : other.effects)
      if (theirs.hypothesis == effect.hypothesis) effect.q = theirs.q;
  return model;
}

std::vector<const Hypothesis*> effects_of(const Candidate& model) {
  std::vector<const Hypothesis*> all;
  for (const auto& effect : model.effects) all.push_back(effect.hypothesis);
  return all;
}

std::size_t alike_to_begin_with(const std::vector<const Hypothesis*>& some, const std::vector<const Hypothesis*>& others) {
  return static_cast<std::size_t>(std::ranges::mismatch(some, others).in1 - some.begin());
}

Ruling judged(Ruling ruling, const Fitter& fitter) {
  ruling.value = ruling.likelihood.total() - 0.5 * fitter.squared_tolerances(ruling.model.axis) -
                 nats_per_parameter * freedom(ruling.model);
  return ruling;
}

Ruling polished_anew(const Fit& fit, const Candidate& start, const ForwardModel& forward, const Fitter& fitter,
                     const PolishWay& way) {
  PolishSettings settings;
  settings.rounds = 1;
  settings.most_iterations = way.most_iterations;
  settings.least_fall_nats = 2.0;
  settings.coloured_from_start = true;
  settings.intervals = false;
  const auto effects = effects_of(start);
  std::shared_ptr<Slopes> learned;
  if (!way.known.slopes) learned = std::make_shared<Slopes>(forward.runs().size());
  settings.known = way.known.slopes.get();
  if (way.of_effects) settings.known_effects = alike_to_begin_with(way.known.effects, effects);
  settings.learned = learned.get();
  settings.least_promise_nats = way.least_promise_nats;
  const auto seen = learned ? SeenSlopes{learned, effects} : way.known;
  Ruling ruling = judged({fit, start, likelihood(forward, extended(start)), 0.0, seen}, fitter);
  settings.behind_nats = std::max(0.0, way.ahead - ruling.value - hopeless_nats);
  const Polished better = polish(forward, fitter, start, settings);
  const auto found = better.moved ? likelihood(forward, extended(better.model)) : ruling.likelihood;
  if (found.total() > ruling.likelihood.total() && !spoils_a_channel(forward, better.model, start, far_worse_polished))
    ruling.model = better.model, ruling.likelihood = found;
  else
    ruling.exhausted = learned && way.most_iterations == further_iterations;
  return judged(std::move(ruling), fitter);
}

Ruling polished(const Fit& fit, const Candidate& start, const ForwardModel& forward, const Fitter& fitter,
                const PolishWay& way) {
  const PolishQuestion question{fitter.nominal(), start, way};
  if (const Ruling* before = forward.before().answer(question)) {
    Ruling ruling = *before;
    ruling.fit = fit;
    return ruling;
  }
  Ruling ruling = polished_anew(fit, start, forward, fitter, way);
  forward.before().note(question, ruling);
  return ruling;
}

}  // namespace

Ruling rule_as_it_is(const Fit& fit, const ForwardModel& forward, const Fitter& fitter) {
  return judged({fit, fit.model, likelihood(forward, extended(fit.model)), 0.0, {}}, fitter);
}

Ruling rule(const Fit& fit, const ForwardModel& forward, const Fitter& fitter, double ahead) {
  return polished(fit, fit.model, forward, fitter, {.most_iterations = first_iterations, .ahead = ahead});
}

Ruling rule_again(const Ruling& before, const ForwardModel& forward, const Fitter& fitter, SlopesOf slopes) {
  if (before.exhausted && slopes == SlopesOf::anew) return before;
  return polished(before.fit, before.model, forward, fitter,
                  {.known = slopes == SlopesOf::before ? before.seen : SeenSlopes{}});
}

Ruling rule_beside(const Ruling& before, const Fit& fit, const ForwardModel& forward, const Fitter& fitter, SlopesOf slopes,
                   double ahead) {
  const Candidate beside = with_numbers_of(before.model, fit.model);
  const double own = likelihood(forward, extended(fit.model)).total();
  const bool better = likelihood(forward, extended(beside)).total() > own;
  return polished(fit, better ? beside : fit.model, forward, fitter,
                  {.known = slopes == SlopesOf::before ? before.seen : SeenSlopes{}, .ahead = ahead});
}

Ruling glance_at_one_more(const Ruling& before, const Fit& fit, const ForwardModel& forward, const Fitter& fitter,
                          double least_promise_nats) {
  return polished(fit, with_numbers_of(before.model, fit.model), forward, fitter,
                  {.known = before.seen, .of_effects = true, .least_promise_nats = least_promise_nats});
}

Ruling rule_with_one_more(const Ruling& before, Fit fit, std::size_t more, const ForwardModel& forward,
                          const Fitter& fitter) {
  Ruling one = rule_beside(before, fit, forward, fitter, SlopesOf::anew);
  if (one.likelihood.total() >= before.likelihood.total()) return one;
  Active& effect = fit.model.effects[more];
  for (std::size_t j = 0; j < effect.q.size(); ++j)
    if (effect.hypothesis->parameters[j].kind == Kind::amplitude) effect.q[j] = 0.0;
  Ruling from_none = rule_beside(before, fit, forward, fitter, SlopesOf::anew);
  return from_none.value > one.value ? from_none : one;
}

Polished polish_settled(const std::optional<Ruling>& settled, const Candidate& otherwise, const ForwardModel& forward,
                        const Fitter& fitter) {
  if (!settled) return polish(forward, fitter, otherwise);
  PolishSettings settings;
  settings.known = settled->seen.slopes.get();
  settings.known_effects = alike_to_begin_with(settled->seen.effects, effects_of(settled->model));
  settings.known_to_begin_with = true;
  return polish(forward, fitter, settled->model, settings);
}

void contest(Ruling& one, Ruling& other, const ForwardModel& forward, const Fitter& fitter) {
  constexpr int most_rounds = 2;
  for (int round = 0; round < most_rounds && !forward.spent(); ++round) {
    Ruling &behind = one.value < other.value ? one : other, &ahead = one.value < other.value ? other : one;
    const Candidate beside = with_numbers_of(ahead.model, behind.model);
    const bool better_beside = likelihood(forward, extended(beside)).total() > behind.likelihood.total();
    if (!better_beside && ahead.value - behind.value > hopeless_nats) return;
    const auto from_the_other = [&] { return polished(behind.fit, beside, forward, fitter, {}); };
    const auto from_its_own = [&] { return rule_again(behind, forward, fitter, SlopesOf::anew); };
    Ruling further = better_beside ? from_the_other() : from_its_own();
    if (further.value < behind.value + of_consequence_nats) {
      Ruling second = better_beside ? from_its_own() : from_the_other();
      if (second.value > further.value) further = std::move(second);
    }
    if (further.value < behind.value + of_consequence_nats) return;
    behind = std::move(further);
  }
}

bool can_be_named(const Active& active, const plant::AxisParameters& axis) {
  return worth_naming(active, axis) && possible(active, axis);
}

}  // namespace feedtwin::tools::diagnosis
