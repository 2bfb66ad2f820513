#include "tools/diagnose/unknown.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/verdict.h"

namespace feedtwin::tools::diagnosis {
namespace {

// of a table: to be a verdict; to be used (one of 0.095 left a held-out run's power 1.18 times as far off)
constexpr double smallest_share_unseen = 0.35, smallest_share_of_use = 0.1;
// since the reversal a contact of many elements made 0.41 where nothing was hidden, and outside the catalogue none needed
// less
constexpr double smallest_share_since_reversal = 0.5;
constexpr double smallest_remainder_N = 0.5;  // that makes a verdict, as any strength; a table is of use from any
// less will do where that share of it is as large a force, over place or speed: there 74 made cases with nothing hidden had
// at most 0.05 of what was left, and 0.1 N of it; a bowl of viscous friction that was missed 0.095 and 0.7 N. Since the
// reversal they had 0.08, and 1 N: a bristle and a real contact differ there
constexpr double lesser_share_unseen = 0.08, smallest_table_N = 0.5;
// nor had any of 126 such, and of 80 with an effect of the catalogue, more than 0.13; a bowl on a quiet axis 0.23 and 0.3 N
constexpr double clear_share_unseen = 0.2, smallest_clear_N = 0.28;

// where a hump of drag over speed was told as two laws 0.24 and 1.5 N; of true pairs of such laws less than 0.1
constexpr double least_share_beside_laws = 0.15;

void tell_what_rings(const Structure& left, Learned& told) {
  if (!left.rings || left.share < told.share_unseen) return;
  const auto& [frequency_Hz, damping_ratio, mass_kg] = *left.rings;
  told.mode = left.rings;
  told.axis = Where::frequency;
  told.low = frequency_Hz * (1.0 - damping_ratio);  // half the power
  told.high = frequency_Hz * (1.0 + damping_ratio);
  told.share_unseen = left.share;
  told.remainder_N = left.remainder_N;
}

}  // namespace

Candidate only_what_the_force_does_not_show(Diagnosis& result, const SearchResult& found, const Candidate& final) {
  std::erase_if(result.effects, [&](const NamedEffect& e) { return rests_on_force(*e.hypothesis); });
  result.verdict = "unknown";
  Candidate told = found.recalibrated.model;
  for (const auto& active : final.effects)
    if (!rests_on_force(*active.hypothesis)) told.effects.push_back(active);
  return told;
}

bool repeats(const Learned& learned) {
  const double table_N = std::sqrt(std::max(0.0, learned.share_unseen)) * learned.remainder_N;
  const bool since_reversal = learned.axis == Where::reversal;
  const double smallest_share = since_reversal ? smallest_share_since_reversal : smallest_share_unseen;
  return (learned.share_unseen > smallest_share && learned.remainder_N > smallest_remainder_N * learned.newton) ||
         (!since_reversal && learned.share_unseen > lesser_share_unseen && table_N > smallest_table_N * learned.newton) ||
         (!since_reversal && learned.share_unseen > clear_share_unseen && table_N > smallest_clear_N * learned.newton);
}

bool laws_of_speed_fall_short(const std::vector<NamedEffect>& named, const Learned& learned) {
  const double table_N = std::sqrt(std::max(0.0, learned.share_unseen)) * learned.remainder_N;
  const auto laws = std::ranges::count_if(named, [](const NamedEffect& e) { return e.hypothesis->law_of_speed; });
  return laws >= 2 && learned.axis == Where::velocity && learned.share_unseen > least_share_beside_laws &&
         table_N > smallest_table_N * learned.newton;
}

void tell_what_no_table_holds(const Fitter& fitter, const Candidate& told, Learned& learned) {
  const Vector residual = fitter.model().residual(told.axis, told.effects);
  learned.sweep = sweep_of(fitter.model(), residual);
  if (learned.sweep) {
    learned.axis = Where::frequency;
    learned.low = learned.sweep->low_Hz, learned.high = learned.sweep->high_Hz;
    return;
  }
  const auto came_at_moments = [&learned](const auto& found) {
    if (found) learned.axis = Where::time, learned.low = found->first_s, learned.high = found->last_s;
    return found.has_value();
  };
  learned.dropouts = dropouts_of(fitter.model(), told);
  if (came_at_moments(learned.dropouts)) return;
  learned.switching = switching_of(fitter.model(), told);
  if (came_at_moments(learned.switching)) return;
  tell_what_rings(fitter.structure().remaining(residual), learned);
}

plant::AxisParameters with_table(const ForwardModel& forward, const Fitter& fitter, const Candidate& told,
                                 const Learned& learned) {
  const Candidate plain = polished_if_closer(forward, fitter, told);
  if (learned.share_unseen < smallest_share_of_use) return extended(plain, worth_naming).common;
  Candidate more = plain;
  extend(more.axis, learned);
  more = polished_if_closer(forward, fitter, more);
  const auto axis = [&](const Candidate& model) { return with_phases_of(told, extended(model, worth_naming).common); };
  return extended(closest(forward, {axis(plain), axis(more)}) == 1 ? more : plain, worth_naming).common;
}

plant::AxisParameters with_reading(const ForwardModel& forward, const Candidate& told, ReadingStructure& reading,
                                   const plant::AxisParameters& axis) {
  if (!reading.table) return axis;
  auto more = axis;
  extend(more, *reading.table);
  reading.in_plant = closest(forward, {with_phases_of(told, axis), with_phases_of(told, more)}) == 1;
  return reading.in_plant ? more : axis;
}

}  // namespace feedtwin::tools::diagnosis
