#include "tools/identify/identification.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "plant/parameter_table.h"
#include "tools/identify/axis_unknowns.h"

namespace feedtwin::tools {
namespace {

bool nuisance(const FittedParameter& fitted) {
  return fitted.parameter.key.starts_with("nuisance.");
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

Identification identify_case(const Case& recordings, const IdentificationSettings& settings) {
  Identification found;
  std::vector<ClosedLoopRun> runs;
  for (const auto& recording : recordings.fit) runs.emplace_back(recording, recordings.axis, recordings.controller);
  const auto unknowns = axis_unknowns(recordings.axis, recordings.fit, settings.force_offset);
  const auto begin = std::chrono::steady_clock::now();
  found.fit = fit_output_error(runs, unknowns, lane_simulator(recordings.axis, unknowns), settings.output_error);
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  found.axis = axis_at(recordings.axis, unknowns, found.fit.point()).parameters;
  for (auto& fitted :
       found.fit.parameters) {  // as it stands in the axis: breakaway never below Coulomb, ends within the range
    const auto* entry = plant::find_parameter(fitted.parameter.key);
    if (entry == nullptr) continue;
    fitted.value = entry->in(found.axis);
    for (double& end : fitted.ci90) end = std::clamp(end, entry->lowest, entry->highest);
  }
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
    out[nuisance(fitted) ? "nuisances" : "parameters"][fitted.parameter.key] = {{"value", fitted.value},
                                                                                {"ci90", {fitted.ci90[0], fitted.ci90[1]}},
                                                                                {"identifiable", fitted.identifiable},
                                                                                {"nominal", fitted.parameter.nominal}};
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
  out["fit_seconds"] = found.seconds;
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
  out += fmt::format("output error: {} residuals, {} runs simulated in {:.2f} s{}\n", found.fit.residuals,
                     found.fit.simulations, found.seconds, found.fit.converged ? "" : "; NOT converged");
  return out;
}

}  // namespace feedtwin::tools
