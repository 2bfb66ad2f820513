#include "tools/diagnose/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnose/command_jump.h"
#include "tools/diagnose/forward/arbiter.h"
#include "tools/diagnose/forward/confirm.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/pictures.h"
#include "tools/diagnose/forward/polish.h"
#include "tools/diagnose/forward/second_look.h"
#include "tools/diagnose/forward/sizes.h"
#include "tools/diagnose/holdout.h"
#include "tools/diagnose/judge.h"
#include "tools/diagnose/own_phase.h"
#include "tools/diagnose/reported.h"
#include "tools/diagnose/sentence.h"
#include "tools/diagnose/verdict.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double smallest_share_unseen = 0.35, smallest_share_of_use = 0.1;  // of a table: to be a verdict, to be used
constexpr double smallest_remainder_N = 1.0;  // that makes a verdict; a table is of use from any

/// Drops what the second engine does not bear out. Numbers of the model are told by how far the others would have to move.
void keep_confirmed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                    const std::function<void(std::string_view)>& progress) {
  for (std::size_t e = fit.model.effects.size(); e-- > 0;) {
    const auto* hypothesis = fit.model.effects[e].hypothesis;
    if (!worth_naming(fit.model.effects[e]) || hypothesis->number_of_the_model) continue;
    auto seen = confirm(forward, fitter, found.whitening, fit.model, e);
    progress(fmt::format("closed loop without {}: {} off by {:.4f} times as much", hypothesis->id,
                         seen.channel.empty() ? "no channel" : seen.channel, seen.error_ratio));
    if (seen.error_ratio > hypothesis->least_error_ratio) continue;
    fit = std::move(seen.without);
    std::erase_if(found.found, [&](const Found& one) { return one.effect.hypothesis == hypothesis; });
  }
}

/// Which axis's closed loop comes closest to the runs of the fit, all channels alike; the first where none is clearly
/// closer.
std::size_t closest(const ForwardModel& forward, const std::vector<AxisByRun>& axes) {
  constexpr double clearly = 0.01;
  const auto far_off = [&forward](const AxisByRun& axis) {
    double sum = 0.0;
    const Nrmse all = forward.nrmse(axis);
    for (const auto& [channel, error] : all) sum += std::log(std::max(1e-12, error));
    return sum / static_cast<double>(std::max<std::size_t>(1, all.size()));
  };
  std::size_t best = 0;
  double least = far_off(axes[0]) - clearly;
  for (std::size_t i = 1; i < axes.size(); ++i) {
    const double error = far_off(axes[i]);
    if (error < least) best = i, least = error;
  }
  return best;
}

/// What recalibration alone can do, by the same measure as the named model: or the gain would be the polishing's.
Candidate polished_if_closer(const ForwardModel& forward, const Fitter& fitter, const Candidate& start) {
  PolishSettings quick;
  quick.rounds = 1;
  quick.coloured_from_start = true;
  quick.intervals = false;
  const Candidate polished = polish(forward, fitter, start, quick).model;
  return closest(forward, {extended(polished), extended(start)}) == 0 ? polished : start;
}

/// The model as the closed loop has its numbers, with the table where that brings the runs of the fit closer.
plant::AxisParameters with_table(const ForwardModel& forward, const Fitter& fitter, const Candidate& told,
                                 const Learned* learned) {
  const Candidate plain = polished_if_closer(forward, fitter, told);
  if (learned == nullptr) return extended(plain, worth_naming).common;
  Candidate more = plain;
  extend(more.axis, *learned);
  more = polished_if_closer(forward, fitter, more);
  const auto axis = [&](const Candidate& model) { return with_phases_of(told, extended(model, worth_naming).common); };
  return extended(closest(forward, {axis(plain), axis(more)}) == 1 ? more : plain, worth_naming).common;
}

/// Takes back the names that rest on the force; what is left of the model.
Candidate only_what_the_force_does_not_show(Diagnosis& result, const SearchResult& found, const Candidate& final) {
  std::erase_if(result.effects, [&](const NamedEffect& e) { return rests_on_force(*e.hypothesis); });
  result.verdict = "unknown";
  Candidate told = found.recalibrated.model;
  for (const auto& active : final.effects)
    if (!rests_on_force(*active.hypothesis)) told.effects.push_back(active);
  return told;
}

void plan_next(Diagnosis& result, const Evidence& seen, const std::function<void(std::string_view)>& progress) {
  const auto open = std::ranges::find_if(result.effects, [](const NamedEffect& e) { return !e.alternatives.empty(); });
  if (open != result.effects.end()) {
    result.next = plan_to_separate(seen, *open->hypothesis, open->alternatives, progress);
    open->sentence += next_move_of(result.next);
  } else if (result.verdict == "cannot-tell") {
    std::vector<Candidate> models;
    for (const auto& suspect : result.suspects) models.push_back(suspect.model);
    result.next = plan_to_prove(seen, models, progress);
  }
}

}  // namespace

Diagnosis diagnose(const Case& given, const std::function<void(std::string_view)>& progress) {
  Case data = given;
  Diagnosis result;
  result.setup = mend_setup(data);
  for (const auto& fault : result.setup) progress(fault.sentence);
  progress("following friction along " + std::to_string(data.fit.size()) + " runs");
  const double jump_share = force_jump_share(data.fit, data.axis);
  if (jump_share < 1.0) progress("the screw yields: the force sensor does not show the command's jumps at once");
  const InverseModel model(make_tracks(data.fit, data.axis, jump_share), data.axis);
  for (auto& fault : check_meter(model.tracks().front(), data.axis)) result.setup.push_back(std::move(fault));
  const Fitter fitter(model, data.axis);
  SearchResult found = search(fitter, Bar{}, progress);
  Fit fit = found.final;
  ForwardModel forward(data.fit, data);
  forward.learn_meter(extended(fit.model));
  const auto& unseen = data.holdout.empty() ? data.fit : data.holdout;
  ForwardModel simulated(unseen, data);
  simulated.take_meter_from(forward);
  keep_confirmed(forward, fitter, found, fit, progress);
  Candidate settled = Arbiter(forward, fitter, progress).settle(found, fit);
  // a name that every unseen fold bears out stays, whatever else is left over
  const bool certain = std::ranges::any_of(found.found, [](const Found& one) {
    return one.held_everywhere && rests_on_force(*one.effect.hypothesis) && worth_naming(one.effect);
  });
  const bool unknown = beyond_the_catalogue(fitter, found, fit.model, progress) && !certain;
  if (!unknown) {
    forward.learn_meter_noise(extended(settled));
    settled = look_again(forward, fitter, found, fit, settled, progress);
  }
  const double inflation = std::max(1.0, fit.cost / static_cast<double>(model.rows()));
  Eigen::MatrixXd covariance = inflation * robust_covariance(model, fit);
  const Fit by_inverse_model = fit;
  progress("polishing the numbers by closed-loop simulation");
  if (!unknown) {
    auto polished = polish(forward, fitter, settled);
    auto ways = ways_of(polished.model);
    const std::size_t of_polished = ways.size();
    for (auto& unpolished : ways_of(fit.model)) ways.push_back(std::move(unpolished));
    if (closest(forward, ways) < of_polished) {
      fit.model = polished.model;
      covariance = with_what_only_inverse_tells(polished.covariance, covariance, polished.model, fit.base_count());
      const std::size_t named = fit.model.effects.size();
      drop_sizeless(forward, by_inverse_model.model, found, fit, covariance, progress);
      if (fit.model.effects.size() < named) fit.model = polished_if_closer(forward, fitter, fit.model);
    }
  }

  if (fit.model.effects.empty()) {
    found.recalibrated.model = fit.model;
  } else {
    found.recalibrated.model = polished_if_closer(forward, fitter, found.recalibrated.model);
  }

  for (const auto& one : found.found) {
    const auto now = std::ranges::find(fit.model.effects, one.effect.hypothesis, &Active::hypothesis);
    if (now != fit.model.effects.end() && worth_naming(*now))
      result.effects.push_back(named_effect(one, fit, covariance, model));
  }
  result.recalibrated = recalibrated(fitter, fit, covariance);
  auto ways = ways_of(fit.model);
  if (result.effects.empty()) ways.push_back(extended(found.recalibrated.model)), ways.push_back(data.axis);
  result.updated = ways[closest(forward, ways)].common;
  if (!anything_missing(result)) result.suspects = suspects(fitter, found, by_inverse_model, Bar{}, progress);
  result.verdict = verdict_of(result);
  result.detection_limit_N = 0.2 * std::max(Bar{}.force_N, found.whitening.residual_rms(0));

  progress("figures on what the fit did not see");
  const Candidate nominal{data.axis, {}};
  const InverseModel held_out(make_tracks(unseen, data.axis, jump_share), data.axis);
  Candidate told = fit.model;
  if (unknown) told = only_what_the_force_does_not_show(result, found, fit.model);
  const Candidate told_unseen = for_unseen(held_out, found.whitening, told);
  const Learned learned = learn_remainder(model, told);
  progress(
      fmt::format("a learned table would explain {:.0f} % of the {:.2g} N left over on runs that it was not learned from",
                  100.0 * learned.share_unseen, learned.remainder_N));
  const bool repeats = learned.share_unseen > smallest_share_unseen;
  if (unknown || (repeats && learned.remainder_N > smallest_remainder_N && !anything_missing(result))) {
    result.verdict = "unknown";
    result.suspects.clear();
    result.unknown = learned;
    if (result.effects.empty()) found.recalibrated.model = polished_if_closer(forward, fitter, found.recalibrated.model);
    result.updated = with_table(forward, fitter, told, learned.share_unseen > smallest_share_of_use ? &learned : nullptr);
  }
  forward.learn_meter_noise(with_phases_of(told, result.updated));
  simulated.take_meter_from(forward);
  result.holdout_inverse = figures(held_out, nominal, found.recalibrated.model, told_unseen);
  const AxisByRun updated_unseen = with_phases_of(told_unseen, result.updated);
  result.holdout = figures(simulated, data.axis, extended(found.recalibrated.model), updated_unseen);
  std::vector<const Hypothesis*> named;
  for (const auto& effect : result.effects) named.push_back(effect.hypothesis);
  result.pictures =
      pictures(simulated, held_out.tracks(), {data.axis, extended(found.recalibrated.model), updated_unseen}, named);
  result.energy_before = energy(held_out, nominal);
  result.energy_after = energy(held_out, told_unseen);
  plan_next(result, {data, forward, fitter, found.whitening, told}, progress);
  result.summary = summary_of(result);
  return result;
}

}  // namespace feedtwin::tools::diagnosis
