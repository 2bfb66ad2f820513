#include "tools/machine/machine_json.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace feedtwin::tools {
namespace {

nlohmann::json to_json(const ComponentPower& p) {
  return {{"pump", p.pump_W},       {"controller", p.controller_W},
          {"spindle", p.spindle_W}, {"feed_drives", p.feed_W},
          {"total", p.total_W()},   {"servo_share", p.total_W() > 0.0 ? p.servo_share() : 0.0}};
}

void print_power(const char* when, const ComponentPower& p) {
  if (p.total_W() == 0.0) return;
  fmt::print(
      "  {:<16} pump {:6.2f} W  controller {:6.2f} W  spindle {:6.2f} W  feed drives {:6.2f} W  servo share {:.1f} %\n",
      when, p.pump_W, p.controller_W, p.spindle_W, p.feed_W, 100.0 * p.servo_share());
}

}  // namespace

nlohmann::json machine_energy_json(const plant::MachineEnergy& e) {
  nlohmann::json energy;
  for (const auto& [name, joules] : energy_by_component(e)) energy[name] = joules;
  energy["auxiliary"] = e.auxiliary_J();
  energy["spindle"] = e.spindle_J();
  energy["feed_drives"] = e.feed_J();
  energy["total"] = e.total_J();
  return energy;
}

nlohmann::json to_json(const MachineTotals& r) {
  nlohmann::json json;
  json["energy_J"] = machine_energy_json(r.energy);
  json["energy_balance_error"] = r.energy.balance_error();
  json["time_s"] = r.time_s;
  json["cutting_time_s"] = r.cutting_time_s;
  json["contour_error_m"] = r.contour_peak_m;
  json["contour_error_rms_m"] = r.contour_rms_m;
  json["tracking_error_m"] = r.tracking_peak_m;
  json["tracking_error_rms_m"] = r.tracking_rms_m;
  json["removed_mm3"] = r.energy.removed_m3 * 1e9;
  json["mrr_mm3_per_s"] = r.removal_rate_m3_per_s() * 1e9;
  json["sec_J_per_mm3"] = r.specific_energy_J_per_m3() * 1e-9;
  json["power_W"] = {{"before_cutting", to_json(r.before_cutting)},
                     {"cutting", to_json(r.cutting)},
                     {"after_cutting", to_json(r.after_cutting)}};
  json["peak_cutting_torque_Nm"] = r.peak_cutting_torque_Nm;
  json["peak_cutting_force_N"] = r.peak_force_N;
  json["clipped_inputs"] = r.clipped_inputs;
  json["stalled_ticks"] = r.stalled_ticks;
  json["ticks"] = r.ticks;
  json["times_real_time"] = r.wall_s > 0.0 ? r.time_s / r.wall_s : 0.0;
  return json;
}

nlohmann::json to_json(const SpecificEnergyFit& fit) {
  return {{"a_W", fit.a_W}, {"b_J_per_mm3", fit.b_J_per_mm3}, {"rms_J_per_mm3", fit.rms_J_per_mm3}, {"points", fit.points}};
}

nlohmann::json to_json(const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& point : points) {
    nlohmann::json json = to_json(point.result);
    for (std::size_t i = 0; i < axes.size(); ++i) json["values"][axes[i].key] = point.values[i];
    all.push_back(json);
  }
  return all;
}

void print(const std::string& name, const MachineResult& r) {
  const auto& e = r.energy;
  fmt::print("{}: {:.2f} s, of which {:.2f} s cut\n", name, r.time_s, r.cutting_time_s);
  fmt::print(
      "  energy           total {:.1f} J  auxiliary {:.1f} J  spindle {:.1f} J  feed drives {:.1f} J  (balance error "
      "{:.1e})\n",
      e.total_J(), e.auxiliary_J(), e.spindle_J(), e.feed_J(), e.balance_error());
  for (const auto& [component, joules] : energy_by_component(e)) fmt::print("    {:<20} {:10.3f} J\n", component, joules);
  print_power("before cutting", r.before_cutting);
  print_power("cutting", r.cutting);
  print_power("after cutting", r.after_cutting);
  if (e.removed_m3 > 0.0) {
    fmt::print(
        "  removed          {:.2f} mm3 at {:.3f} mm3/s, {:.3f} J/mm3; torque up to {:.4f} N m, force up to {:.2f} N\n",
        e.removed_m3 * 1e9, r.removal_rate_m3_per_s() * 1e9, r.specific_energy_J_per_m3() * 1e-9, r.peak_cutting_torque_Nm,
        r.peak_force_N);
  }
  fmt::print("  contour error    peak {:.2f} um, rms {:.2f} um; tracking peak {:.2f} um, rms {:.2f} um\n",
             r.contour_peak_m * 1e6, r.contour_rms_m * 1e6, r.tracking_peak_m * 1e6, r.tracking_rms_m * 1e6);
  if (r.clipped_inputs > 0) fmt::print("  note: {} inputs were clipped\n", r.clipped_inputs);
  if (r.stalled_ticks > 0) {
    fmt::print("  note: {} ticks pushed the tool into material with the spindle standing; no force was modelled there\n",
               r.stalled_ticks);
  }
  fmt::print("  {:.0f} times real time\n", r.wall_s > 0.0 ? r.time_s / r.wall_s : 0.0);
}

void print_comparison(const std::string& name_a, const MachineResult& a, const std::string& name_b, const MachineResult& b) {
  fmt::print("A: {}\nB: {}\n  {:<22} {:>12} {:>12} {:>12} {:>9}\n", name_a, name_b, "", "A", "B", "B - A", "");
  const auto row = [](const std::string& what, const char* unit, double x, double y) {
    fmt::print("  {:<22} {:>10.3f} {} {:>10.3f} {} {:>+10.3f} {}", what, x, unit, y, unit, y - x, unit);
    if (x != 0.0) fmt::print(" {:>+8.1f} %", 100.0 * (y / x - 1.0));
    fmt::print("\n");
  };
  const auto parts_a = energy_by_component(a.energy), parts_b = energy_by_component(b.energy);
  for (std::size_t i = 0; i < parts_a.size(); ++i) row(parts_a[i].first, "J", parts_a[i].second, parts_b[i].second);
  row("auxiliary", "J", a.energy.auxiliary_J(), b.energy.auxiliary_J());
  row("spindle", "J", a.energy.spindle_J(), b.energy.spindle_J());
  row("feed drives", "J", a.energy.feed_J(), b.energy.feed_J());
  row("total", "J", a.energy.total_J(), b.energy.total_J());
  row("time", "s", a.time_s, b.time_s);
  row("cutting power", "W", a.cutting.total_W(), b.cutting.total_W());
  row("contour error", "um", a.contour_peak_m * 1e6, b.contour_peak_m * 1e6);
}

}  // namespace feedtwin::tools
