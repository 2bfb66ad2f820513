#include "tools/identify/identification.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "plant/parameter_table.h"
#include "tools/identify/axis_unknowns.h"
#include "tools/identify/joint_intervals.h"
#include "tools/identify/stages/stage_report.h"
#include "tools/intervals.h"

namespace feedtwin::tools {
namespace {

bool nuisance(const FittedParameter& fitted) {
  return fitted.parameter.key.starts_with("nuisance.");
}

template <class Work>
double seconds_of(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Two columns: where either set of unknowns starts.
Eigen::MatrixXd starts_of(const std::vector<FitParameter>& first, const std::vector<FitParameter>& second) {
  Eigen::MatrixXd points(static_cast<Eigen::Index>(first.size()), 2);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    points(row, 0) = first[i].start.value_or(first[i].nominal);
    points(row, 1) = second[i].start.value_or(second[i].nominal);
  }
  return points;
}

/// The command alone leaves valleys beside each other, and the axis file's may be deeper than the stages': both are gone
/// down a first time, and the unknowns start from the end of the deeper one.
/// @return whether that is the stages'
bool take_deeper_valley(const std::vector<ClosedLoopRun>& runs, const BatchSimulator& simulate,
                        const OutputErrorSettings& settings, std::vector<FitParameter>& unknowns) {
  auto of_axis_file = unknowns;
  for (auto& unknown : of_axis_file) unknown.start.reset();
  const auto ends = first_fits(runs, unknowns, simulate, starts_of(unknowns, of_axis_file), settings);
  const Eigen::VectorXd costs = output_error_cost(runs, of_axis_file, simulate, settings)(ends);
  const bool stages = costs[0] <= costs[1];
  for (std::size_t i = 0; i < unknowns.size(); ++i) unknowns[i].start = ends(static_cast<Eigen::Index>(i), stages ? 0 : 1);
  return stages;
}

/// A population about the start: between a third and three times each number (or within its bounds), on simulated cost.
void evolve_start(const std::vector<ClosedLoopRun>& runs, const BatchSimulator& simulate,
                  const IdentificationSettings& settings, std::vector<FitParameter>& unknowns, Identification& found) {
  const auto n = static_cast<Eigen::Index>(unknowns.size());
  Eigen::VectorXd lowest(n), highest(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& p = unknowns[static_cast<std::size_t>(i)];
    const double start = p.start.value_or(p.nominal);
    const double reach = start != 0.0 ? std::abs(start) : p.scale;
    lowest[i] = std::max(p.lowest, start > 0.0 ? start / 3.0 : start - 2.0 * reach);
    highest[i] = std::min(p.highest, start + 2.0 * reach);
  }
  const auto cost = output_error_cost(runs, unknowns, simulate, settings.output_error);
  const auto evolved = evolve(lowest, highest, cost, settings.population, starts_of(unknowns, unknowns).col(0));
  found.population_evaluations = evolved.evaluations;
  for (Eigen::Index i = 0; i < n; ++i) unknowns[static_cast<std::size_t>(i)].start = evolved.point[i];
  if (settings.output_error.progress) {
    settings.output_error.progress(
        fmt::format("population: {} generations, {} candidates simulated", evolved.generations, evolved.evaluations));
  }
}

/// Each number as it stands in the axis, breakaway never below Coulomb, with intervals whose ends are within its range.
void settle_numbers(Identification& found) {
  const auto of_axis = [](const FittedParameter& fitted) { return plant::find_parameter(fitted.parameter.key) != nullptr; };
  const auto numbers = static_cast<std::size_t>(std::ranges::count_if(found.fit.parameters, of_axis));
  for (auto& fitted : found.fit.parameters) {
    const auto* entry = plant::find_parameter(fitted.parameter.key);
    if (entry == nullptr) continue;
    const double half = joint_90(numbers, fitted.degrees_of_freedom) * fitted.deviation;
    fitted.joint_ci90 = {fitted.value - half, fitted.value + half};
    for (double& end : fitted.ci90) end = std::clamp(end, entry->lowest, entry->highest);
    for (double& end : *fitted.joint_ci90) end = std::clamp(end, entry->lowest, entry->highest);
    fitted.value = entry->in(found.axis);
  }
}

/// What trades with an encoder's rounding is of no use to anybody.
void drop_nuisances(std::vector<Trade>& trades) {
  for (auto& trade : trades) {
    for (std::size_t i = trade.keys.size(); i-- > 0;) {
      if (!trade.keys[i].starts_with("nuisance.")) continue;
      trade.keys.erase(trade.keys.begin() + static_cast<std::ptrdiff_t>(i));
      trade.weights.erase(trade.weights.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  std::erase_if(trades, [](const Trade& trade) { return trade.keys.empty(); });
}

/// By how much the intervals are wider that hold all numbers at once.
std::string joint_line(const OutputErrorFit& fit) {
  std::size_t numbers = 0;
  double least_dof = std::numeric_limits<double>::infinity();
  for (const auto& fitted : fit.parameters) {
    if (!fitted.joint_ci90) continue;
    ++numbers;
    least_dof = std::min(least_dof, fitted.degrees_of_freedom);
  }
  if (numbers < 2) return {};
  const double least = joint_90(numbers, std::numeric_limits<double>::infinity()) / normal_90;
  const double most = joint_90(numbers, least_dof) / normal_90;
  const auto times = most - least < 0.005 ? fmt::format("{:.2f}", least) : fmt::format("{:.2f} to {:.2f}", least, most);
  return fmt::format("all {} at once: intervals {} times as wide (JSON: joint_ci90)\n", numbers, times);
}

nlohmann::json to_json(const RigidFit& fit) {
  return {{"mass_kg", fit.mass_kg},
          {"viscous_pos_Ns_per_m", fit.viscous_pos_Ns_per_m},
          {"viscous_neg_Ns_per_m", fit.viscous_neg_Ns_per_m},
          {"coulomb_N", fit.coulomb_N},
          {"offset_N", fit.offset_N},
          {"rel_error", fit.relative_error}};
}

}  // namespace

std::span<const MethodName> method_names() noexcept {
  static constexpr std::array names{
      MethodName{"staged", "stage by stage in closed form, then all together", Method::staged},
      MethodName{"ga", "the stages by the source's genetic algorithm, then all together", Method::genetic},
      MethodName{"population", "a genetic algorithm over everything on closed-loop simulation, then all together",
                 Method::population},
      MethodName{"joint", "all together at once, from the axis file", Method::joint},
  };
  return names;
}

Identification identify_case(const Case& recordings, const IdentificationSettings& settings) {
  Identification found;
  found.method = settings.method;
  std::vector<ClosedLoopRun> runs;
  for (const auto& recording : recordings.fit) runs.emplace_back(recording, recordings.axis, recordings.controller);
  auto unknowns = axis_unknowns(recordings.axis, recordings.fit, settings.force_offset);
  const auto simulate = lane_simulator(recordings.axis, unknowns);
  const auto search = settings.method == Method::genetic ? StageSearch::genetic : StageSearch::projected;
  found.stage_seconds = seconds_of([&] { found.stages = identify_by_stages(recordings.axis, recordings.fit, search); });
  if (settings.method != Method::joint) {
    auto staged = unknowns;
    start_from(staged, found.stages.axis);
    const Eigen::VectorXd costs =
        output_error_cost(runs, unknowns, simulate, settings.output_error)(starts_of(unknowns, staged));
    found.started_from_stages = costs[1] < costs[0];  // missing physics can lead a stage astray
    if (found.started_from_stages) unknowns = std::move(staged);
  }
  if (settings.method == Method::population) {
    found.population_seconds = seconds_of([&] { evolve_start(runs, simulate, settings, unknowns, found); });
  }
  found.seconds = seconds_of([&] {
    if (found.started_from_stages && found.stages.contacts.empty())
      found.started_from_stages = take_deeper_valley(runs, simulate, settings.output_error, unknowns);
    found.fit = fit_output_error(runs, unknowns, simulate, settings.output_error);
  });
  found.axis = axis_at(recordings.axis, unknowns, found.fit.point()).parameters;
  settle_numbers(found);
  drop_nuisances(found.fit.trades);
  found.before = compare_case(recordings, recordings.axis);
  found.after = compare_case(recordings, found.axis);
  const auto motion = recorded_motion(recordings.fit.front(), recordings.axis.axis.lead_m, {.held_command = false});
  found.rigid = fit_rigid_model(motion, false);
  found.rigid_directional = fit_rigid_model(motion, true);
  return found;
}

nlohmann::json to_json(const Identification& found) {
  nlohmann::json out = to_json(found.after);
  out["parameters"] = nlohmann::json::object();
  out["nuisances"] = nlohmann::json::object();
  for (const auto& fitted : found.fit.parameters) {
    auto& one = out[nuisance(fitted) ? "nuisances" : "parameters"][fitted.parameter.key];
    one = {{"value", fitted.value},
           {"ci90", {fitted.ci90[0], fitted.ci90[1]}},
           {"identifiable", fitted.identifiable},
           {"nominal", fitted.parameter.nominal}};
    if (fitted.joint_ci90) one["joint_ci90"] = *fitted.joint_ci90;
  }
  out["trades"] = nlohmann::json::array();
  for (const auto& trade : found.fit.trades) {
    nlohmann::json one = nlohmann::json::object();
    for (std::size_t i = 0; i < trade.keys.size(); ++i) one[trade.keys[i]] = trade.weights[i];
    out["trades"].push_back(std::move(one));
  }
  out["before"] = to_json(found.before)["closed_loop"];
  out["rigid_inverse_model"] = {{"symmetric", to_json(found.rigid)}, {"directional", to_json(found.rigid_directional)}};
  out["converged"] = found.fit.converged;
  out["method"] = std::ranges::find(method_names(), found.method, &MethodName::method)->name;
  out["stages"] = to_json(found.stages);
  out["started_from"] = found.started_from_stages ? "stages" : "axis file";
  if (found.population_evaluations > 0) out["population_evaluations"] = found.population_evaluations;
  out["seconds"] = {
      {"stages", found.stage_seconds}, {"population", found.population_seconds}, {"output_error", found.seconds}};
  out["simulated_runs"] = found.fit.simulations;
  return out;
}

std::string to_text(const Identification& found) {
  std::string out = fmt::format("{:<36} {:>13} {:>13} {:>29}\n", "parameter", "axis file", "identified", "90 % interval");
  for (const auto& fitted : found.fit.parameters) {
    if (nuisance(fitted)) continue;
    out +=
        fmt::format("{:<36} {:>13.6g} {:>13.6g} [{:>13.6g},{:>13.6g}]{}\n", fitted.parameter.key, fitted.parameter.nominal,
                    fitted.value, fitted.ci90[0], fitted.ci90[1], fitted.identifiable ? "" : "  not told by these data");
  }
  out += joint_line(found.fit);
  for (const auto& trade : found.fit.trades) {
    if (trade.keys.size() < 2) continue;
    std::string members;
    for (std::size_t i = 0; i < trade.keys.size(); ++i)
      members += fmt::format("{}{} {:+.2f}", i > 0 ? ", " : "", trade.keys[i], trade.weights[i]);
    out += fmt::format("these data tell only the sum over: {}\n", members);
  }
  out += fmt::format("\n{:<18} {:>22} {:>22}\n", "closed loop", "rms error, axis file", "rms error, identified");
  for (const auto& [name, metrics] : found.after.closed_loop) {
    out += fmt::format("  {:<16} {:>14.5g} {:>6.2f}% {:>14.5g} {:>6.2f}%\n", name, found.before.closed_loop.at(name).rms,
                       100.0 * found.before.closed_loop.at(name).rel_error, metrics.rms, 100.0 * metrics.rel_error);
  }
  out += fmt::format(
      "inverse model, rigid, symmetric friction: M {:.3f} kg, Fv {:.2f} N s/m, Fc {:.3f} N, offset {:.3f} N, error {:.3f} "
      "%\n",
      found.rigid.mass_kg, found.rigid.viscous_pos_Ns_per_m, found.rigid.coulomb_N, found.rigid.offset_N,
      100.0 * found.rigid.relative_error);
  out += fmt::format("               with viscous friction by direction: Fv {:.2f} / {:.2f} N s/m, error {:.3f} %\n",
                     found.rigid_directional.viscous_pos_Ns_per_m, found.rigid_directional.viscous_neg_Ns_per_m,
                     100.0 * found.rigid_directional.relative_error);
  for (const auto& note : found.stages.notes) out += fmt::format("stage {}\n", note);
  out += fmt::format("stages: {} numbers in {:.1f} ms; output error started from {}\n", found.stages.keys.size(),
                     1e3 * found.stage_seconds, found.started_from_stages ? "them" : "the axis file");
  out += fmt::format("output error: {} residuals, {} runs simulated in {:.2f} s{}\n", found.fit.residuals,
                     found.fit.simulations, found.seconds, found.fit.converged ? "" : "; NOT converged");
  return out;
}

}  // namespace feedtwin::tools
