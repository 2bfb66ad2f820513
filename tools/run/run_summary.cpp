#include "tools/run/run_summary.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "plant/parameter_table.h"
#include "tools/machine/machine_json.h"
#include "tools/machine/machine_run.h"
#include "tools/run/axis_components.h"

namespace feedtwin::tools {
namespace {

using nlohmann::json;

struct Percentile {
  const char* name;
  double share;
};
constexpr Percentile percentiles[] = {
    {"p50", 0.5}, {"p99", 0.99}, {"p99_9", 0.999}, {"p99_99", 0.9999}, {"p99_999", 0.99999}};

json to_json(const rt::LatencyHistogram& histogram) {
  json out;
  for (const auto& percentile : percentiles) out[percentile.name] = histogram.percentile_us(percentile.share);
  out["max"] = static_cast<double>(histogram.max_ns()) * 1e-3;
  return out;
}

json bins(const rt::LatencyHistogram& histogram) {
  json edges = json::array();
  json counts = json::array();
  histogram.each([&](double edge_us, std::uint64_t count) {
    edges.push_back(edge_us);
    counts.push_back(count);
  });
  return {{"upper_edge_us", edges}, {"count", counts}};
}

json to_json(const plant::AxisEnergy& e) {
  json out;
  for (const auto& component : axis_components) out[component.name] = e.*component.joules;
  return out;
}

plant::AxisEnergy sum(const std::vector<plant::AxisEnergy>& axes) {
  plant::AxisEnergy total;
  for (const auto& energy : axes) total += energy;
  return total;
}

json to_json(const MachineFacts& facts) {
  json out{{"energy_J", machine_energy_json(facts.energy)},
           {"energy_balance_error", facts.energy.balance_error()},
           {"time_s", facts.energy.time_s},
           {"removed_mm3", facts.energy.removed_m3 * 1e9}};
  if (facts.contour_peak_m) out["contour_error_m"] = *facts.contour_peak_m;
  return out;
}

void print_machine(const MachineFacts& facts) {
  fmt::print("\nMachine: {:.1f} s, {:.1f} J, {:.2f} mm3 removed; balance open by {:.1e}\n", facts.energy.time_s,
             facts.energy.total_J(), facts.energy.removed_m3 * 1e9, facts.energy.balance_error());
  for (const auto& [component, joules] : energy_by_component(facts.energy))
    fmt::print("  {:<20} {:10.3f} J\n", component, joules);
  if (facts.contour_peak_m) fmt::print("  contour error up to {:.2f} um\n", *facts.contour_peak_m * 1e6);
}

void print_row(const char* what, const rt::LatencyHistogram& histogram) {
  fmt::print("  {:<12}", what);
  for (const auto& percentile : percentiles) fmt::print(" {:>9.1f}", histogram.percentile_us(percentile.share));
  fmt::print(" {:>9.1f}\n", static_cast<double>(histogram.max_ns()) * 1e-3);
}

void print_energy(const RunSummary& summary) {
  fmt::print("\nEnergy, J            motor electrical  motor mechanical  ball screw     guide\n");
  const auto row = [](const std::string& name, const plant::AxisEnergy& e) {
    fmt::print("  {:<18} {:>16.3f}  {:>16.3f}  {:>10.3f}  {:>8.3f}\n", name, e.motor_electrical_J, e.motor_mechanical_J,
               e.ball_screw_J, e.guide_J);
  };
  for (std::size_t i = 0; i < summary.energy.size(); ++i) row(fmt::format("axis {}", i), summary.energy[i]);
  const auto total = sum(summary.energy);
  if (summary.energy.size() > 1) row("all", total);
  fmt::print("  work in {:.3f} J; balance open by {:.1e} of the work that passed through\n", total.input_work_J,
             total.balance_error());
}

}  // namespace

nlohmann::json to_json(const RunSummary& summary) {
  const auto& stats = *summary.stats;
  const auto total = sum(summary.energy);
  json out;
  out["verb"] = summary.verb;
  out["configuration"] = summary.source;
  out["controller"] = summary.controller;
  out["period_s"] = summary.tick_s;
  out["parameter_hash"] = summary.parameter_hash;
  out["ticks"] = stats.ticks;
  out["missed_ticks"] = stats.missed_ticks;
  out["late_starts"] = stats.late_starts;
  out["dropped_rows"] = stats.dropped_records;
  out["verdict"] = rt::name(summary.verdict.verdict);
  out["reasons"] = summary.verdict.reasons;
  out["wakeup_us"] = to_json(stats.wakeup);
  out["tick_us"] = to_json(stats.work);
  out["input_age_us"] = to_json(stats.input_age);
  if (stats.reply.total() > 0) out["reply_us"] = to_json(stats.reply);
  out["histograms"] = {{"wakeup", bins(stats.wakeup)}, {"tick", bins(stats.work)}, {"input_age", bins(stats.input_age)}};
  if (stats.reply.total() > 0) out["histograms"]["reply"] = bins(stats.reply);
  out["energy_J"] = to_json(total);
  out["energy_balance_error"] = total.balance_error();
  out["input_work_J"] = total.input_work_J;
  if (summary.machine) {
    out["machine"] = to_json(*summary.machine);
    out["energy_balance_error"] = summary.machine->energy.balance_error();
  }
  for (const auto& energy : summary.energy) {
    out["axes"].push_back({{"energy_J", to_json(energy)},
                           {"energy_balance_error", energy.balance_error()},
                           {"input_work_J", energy.input_work_J},
                           {"cutting_J", energy.cutting_J},
                           {"load_J", energy.load_J},
                           {"lost_J", energy.lost_J},
                           {"stored_J", energy.stored_J},
                           {"kinetic_J", energy.kinetic_J}});
  }
  out["real_time"] = json::array();
  for (const auto& s : summary.settings) {
    out["real_time"].push_back(
        {{"what", s.what}, {"asked", s.asked}, {"got", s.got}, {"why", s.why}, {"granted", s.granted}});
  }
  out["files"] = summary.files;
  return out;
}

void print(const RunSummary& summary) {
  const auto& stats = *summary.stats;
  fmt::print("\n{} ticks of {:g} ms, {} missed\n\n", stats.ticks, summary.tick_s * 1e3, stats.missed_ticks);
  fmt::print("Times, us        {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "p50", "p99", "p99.9", "p99.99", "p99.999", "max");
  print_row("wake-up", stats.wakeup);
  print_row("tick", stats.work);
  print_row("input age", stats.input_age);
  if (stats.reply.total() > 0) print_row("reply", stats.reply);
  print_energy(summary);
  if (summary.machine) print_machine(*summary.machine);
  fmt::print("\nVerdict: {}\n", rt::name(summary.verdict.verdict));
  for (const auto& reason : summary.verdict.reasons) fmt::print("  - {}\n", reason);
  for (const auto& file : summary.files) fmt::print("Written: {}\n", file);
}

std::string parameter_hash(std::vector<plant::AxisParameters> axes) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&hash](std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  };
  for (auto& axis : axes) {
    for (const auto& entry : plant::parameter_table()) add(fmt::format("{}={:.17g}\n", entry.key, entry.in(axis)));
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace feedtwin::tools
