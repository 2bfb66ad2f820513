#include "tools/diagnose/soft_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/reported.h"
#include "tools/diagnose/sentence.h"
#include "tools/intervals.h"

namespace feedtwin::tools::diagnosis {

/// Contacts of eight slipping elements with nothing hidden left a bristle of 0.32 to 0.5 of the file's stiffness beside 14
/// to 36 N over 5 to 6 um; hidden memories, of 4 to 24 um, left one of 0.16 beside 36 N over 16 um and one of 0.03 beside 42
/// N over 12 um, which is 6 and 9 times what their friction yields on the file's bristle.
bool worth_telling(const Active& active, const plant::AxisParameters& now, const plant::AxisParameters& nominal) {
  constexpr double softened = 0.22, of_the_files_bristle = 4.5, least_N = 5.0;
  if (worth_naming(active, now)) return true;
  if (active.hypothesis->id != "presliding_memory") return false;
  const double force_N = active.q[0], distance_m = active.q[1], file_N_per_m = nominal.ball_screw.stiffness_N_per_m;
  const double yields_m = (mean(now.ball_screw.coulomb_N) + force_N) / file_N_per_m;
  return force_N > least_N && now.ball_screw.stiffness_N_per_m < softened * file_N_per_m &&
         distance_m > of_the_files_bristle * yields_m;
}

std::optional<NamedEffect> memory_in_the_bristle(const Diagnosis& told, const Fit& fit) {
  constexpr double softened = 0.17, surely_softened = 0.18, least_yield_m = 5e-6;
  constexpr double most_yield_m = 5e-4;  // none is half a millimetre deep: a stop that was struck bends the numbers so
  const Hypothesis& own = hypothesis("presliding_memory");
  const auto takes_it_up = [&](const NamedEffect& one) {
    return one.hypothesis == &own || easily_confused(*one.hypothesis, own) || one.hypothesis->id == "screw_compliance";
  };
  const auto bristle = std::ranges::find(told.recalibrated, "ball_screw.sigma0_N_per_m", &Recalibrated::key);
  // where the law itself was free to take it, beside the bristle, and did not, it is none
  if (has(fit.model, own) || bristle == told.recalibrated.end() || std::ranges::any_of(told.effects, takes_it_up))
    return std::nullopt;
  const auto& now = bristle->now;
  const double force_N = mean(fit.model.axis.ball_screw.coulomb_N), yields_m = force_N / now.value;
  if (now.value > softened * bristle->was || now.high > surely_softened * bristle->was || yields_m < least_yield_m ||
      yields_m > most_yield_m)
    return std::nullopt;
  // of a screw whose friction hardly counts beside the guide's, the bristle takes what any contact leaves: on another
  // generator's axes with nothing hidden 0.05 and 0.13 of the file's were left, with 3 to 5 % of the friction
  constexpr double least_share = 0.1;
  if (force_N < least_share * (force_N + mean(fit.model.axis.guide.coulomb_N))) return std::nullopt;
  const double deviation = std::max(0.5 * (now.high - now.low) / normal_90, 1e-3 * now.value);
  NamedEffect effect = held_by_numbers(own, std::pow((bristle->was - now.value) / deviation, 2), fit);
  // a bristle begins as steeply as elements of all yields up to twice its own; which of them there are it does not say
  constexpr double as_steep = 2.0, at_least = 1.3, at_most = 3.0, force_share = 0.3;
  effect.parameters = {
      {"force_N", {force_N, (1.0 - force_share) * force_N, (1.0 + force_share) * force_N}},
      {"distance_m", {as_steep * yields_m, at_least * force_N / now.high, at_most * force_N / std::max(now.low, 1.0)}}};
  effect.intervals = {{0.0, about_a_reversal_s}};
  effect.sentence = sentence_of(effect);
  effect.sentence += fmt::format(" The recalibrated bristle of the ball screw holds it, {:.0f} times as soft as the file's.",
                                 bristle->was / now.value);
  return effect;
}

}  // namespace feedtwin::tools::diagnosis
