#include "tools/diagnose/forward/extended_axis.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "plant/effects/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/own_phase.h"
#include "tools/diagnose/windows.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// Breakaway friction is never below Coulomb friction.
void keep_breakaway(plant::LugreParameters& friction) {
  friction.static_N.pos = std::max(friction.static_N.pos, friction.coulomb_N.pos);
  friction.static_N.neg = std::max(friction.static_N.neg, friction.coulomb_N.neg);
}

/// The compliance that was found is that of everything between screw and table: the gap's own contact adds none.
void join_contact(plant::EffectSetting& gap, const plant::EffectSetting& spring) {
  const auto &of_gap = *plant::find_effect("backlash"), &of_spring = *plant::find_effect("screw_compliance");
  plant::EffectSetting copy = spring;
  for (const char* name : {"stiffness_N_per_m", "damping_Ns_per_m"}) {
    const auto known = std::ranges::find(of_gap.parameters, name, &plant::EffectParameter::name);
    const double found = *plant::value_in(copy, of_spring, name);
    *plant::value_in(gap, of_gap, name) = std::min(known->highest, 1e3 * found);
  }
}

/// A number of an effect that the runs do not share.
void set_number(plant::AxisParameters& axis, const Active& active, std::string_view name, double value) {
  const auto setting = std::ranges::find(axis.effects, active.hypothesis->id, &plant::EffectSetting::id);
  if (setting == axis.effects.end()) return;
  const auto& entry = *plant::find_effect(setting->id);
  const auto known = std::ranges::find(entry.parameters, name, &plant::EffectParameter::name);
  *plant::value_in(*setting, entry, name) = std::clamp(value, known->lowest, known->highest);
}

void set_phases(AxisByRun& all, const Active& line) {
  constexpr auto name = "phase_rad";
  set_number(all.common, line, name, std::arg(common_line(line)));
  for (std::size_t run = 0; run < line_runs; ++run)
    set_number(all.runs[run], line, name, std::arg(line.hypothesis->line_of(line.q, run)));
}

/// One setting a part: the same force in each. An axis that is handed on has those of another run.
void set_parts_of(plant::AxisParameters& axis, const Active& active, const Windows& windows) {
  if (windows.empty()) return;
  const auto is_one = [&](const plant::EffectSetting& setting) { return setting.id == active.hypothesis->id; };
  const auto found = std::ranges::find_if(axis.effects, is_one);
  if (found == axis.effects.end()) return;
  std::vector<plant::EffectSetting> parts(windows.size(), *found);
  std::erase_if(axis.effects, is_one);
  const auto& entry = *plant::find_effect(active.hypothesis->id);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    *plant::value_in(parts[i], entry, "start_s") = windows[i].start_s;
    *plant::value_in(parts[i], entry, "end_s") = windows[i].end_s;
  }
  axis.effects.insert(axis.effects.end(), parts.begin(), parts.end());
}

/// The first run's are what is handed on.
void set_parts(AxisByRun& all, const Active& active) {
  for (std::size_t run = 0; run < line_runs; ++run)
    set_parts_of(all.runs[run], active, windows_of_run(active.hypothesis->first_window, active.q, run));
  set_parts_of(all.common, active, windows_of_run(active.hypothesis->first_window, active.q, 0));
}

void set_states(AxisByRun& all, const Active& active) {
  const auto name = active.hypothesis->state;
  set_number(all.common, active, name, mean_state(active));
  for (std::size_t run = 0; run < line_runs; ++run)
    set_number(all.runs[run], active, name, active.q[state_of_run(active.hypothesis->first_state, run)]);
}

}  // namespace

AxisByRun with_phases_of(const Candidate& model, plant::AxisParameters axis) {
  AxisByRun all(std::move(axis));
  for (const auto& active : model.effects) {
    const Hypothesis& h = *active.hypothesis;
    if (h.line_of == nullptr && h.state.empty()) continue;
    if (all.runs.empty()) all.runs.assign(line_runs, all.common);
    if (h.line_of != nullptr) set_phases(all, active);
    if (!h.state.empty()) set_states(all, active);
    if (windowed(active)) set_parts(all, active);
  }
  return all;
}

AxisByRun extended(const Candidate& candidate, const Kept& kept) {
  plant::AxisParameters axis = candidate.axis;
  keep_breakaway(axis.ball_screw);
  keep_breakaway(axis.guide);
  for (const auto& active : candidate.effects) {
    const auto* entry = plant::find_effect(active.hypothesis->id);
    if (entry == nullptr || (kept && !kept(active, candidate.axis))) continue;
    auto setting = plant::preset_of(*entry);
    for (const auto& [name, value] : active.hypothesis->named(active.q, candidate.axis)) {
      double* place = plant::value_in(setting, *entry, name);
      if (place == nullptr) continue;
      const auto known = std::ranges::find(entry->parameters, name, &plant::EffectParameter::name);
      *place = std::clamp(value, known->lowest, known->highest);
    }
    axis.effects.push_back(std::move(setting));
  }
  if (const auto gap = std::ranges::find(axis.effects, "backlash", &plant::EffectSetting::id),
      spring = std::ranges::find(axis.effects, "screw_compliance", &plant::EffectSetting::id);
      gap != axis.effects.end() && spring != axis.effects.end())
    join_contact(*gap, *spring);
  return with_phases_of(candidate, std::move(axis));
}

std::vector<AxisByRun> ways_of(const Candidate& candidate) {
  std::vector<AxisByRun> ways{extended(candidate, worth_naming)};
  const auto is_finding = [&](const Active& active) { return worth_naming(active, candidate.axis); };
  if (!std::ranges::all_of(candidate.effects, is_finding)) ways.push_back(extended(candidate));
  return ways;
}

}  // namespace feedtwin::tools::diagnosis
