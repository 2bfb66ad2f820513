// Files of a case in the formats of the public contract, and its key.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/challenge/challenge_case.h"

namespace feedtwin::challenge {
namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::string friction_text(const Friction& f, const char* table, const std::string& first, double sigma0, double sigma1) {
  std::string text = fmt::format("\n[{}]\n{}", table, first);
  const auto both = [&](const char* name, const char* unit, double Side::* member) {
    text += fmt::format("{0}_pos_{1} = {2:.6g}\n{0}_neg_{1} = {3:.6g}\n", name, unit, f.pos.*member, f.neg.*member);
  };
  both("coulomb", "N", &Side::coulomb_N);
  both("static", "N", &Side::static_N);
  both("stribeck", "m_per_s", &Side::stribeck_m_per_s);
  both("viscous", "Ns_per_m", &Side::viscous_Ns_per_m);
  return text + fmt::format("sigma0_N_per_m = {:.6g}\nsigma1_Ns_per_m = {:.6g}\n", sigma0, sigma1);
}

std::string axis_text(const Axis& a) {
  std::string text = "# Nominal axis, SI units. _pos and _neg: direction of motion.\n[axis]\n";
  text += fmt::format("lead_m = {}\nstroke_m = {}\ntorque_limit_Nm = {}\nencoder_counts_per_rev = {}\n\n[motor]\n", a.lead_m,
                      a.stroke_m, a.torque_limit_Nm, a.counts_per_rev);
  text += fmt::format("inertia_kgm2 = {:.6g}\ndamping_pos_Nms = {:.6g}\ndamping_neg_Nms = {:.6g}\n", a.motor_inertia_kgm2,
                      a.motor_damping_pos_Nms, a.motor_damping_neg_Nms);
  text += fmt::format("coulomb_pos_N = {:.6g}\ncoulomb_neg_N = {:.6g}\nke0_W = {:.6g}\n", a.motor_coulomb_pos_N,
                      a.motor_coulomb_neg_N, a.ke0_W);
  text += fmt::format("ke1_pos_Ws_per_m = {:.6g}\nke1_neg_Ws_per_m = {:.6g}\n", a.ke1_pos, a.ke1_neg);
  text += fmt::format("ke2_pos_Ws2_per_m2 = {:.6g}\nke2_neg_Ws2_per_m2 = {:.6g}\n", a.ke2_pos, a.ke2_neg);
  text += friction_text(a.screw, "ball_screw", fmt::format("inertia_kgm2 = {:.6g}\n", a.screw_inertia_kgm2), 5.08e7, 7706.0);
  return text + friction_text(a.guide, "guide", fmt::format("mass_kg = {:.6g}\n", a.table_kg), 5.09e5, 1222.0);
}

std::string run_text(const Run& run, unsigned channels) {
  std::string text = "time_s,torque_cmd_Nm,position_m";
  if (channels & scale) text += ",scale_position_m";
  if (channels & torque_sensor) text += ",torque_sensor_Nm";
  if (channels & force_sensor) text += ",force_sensor_N";
  if (channels & power) text += ",power_W";
  text += '\n';
  for (const Sample& s : run) {
    if (!std::isfinite(s.torque_cmd_Nm + s.position_m + s.force_sensor_N + s.power_W))
      throw std::runtime_error(fmt::format("not finite at {:.3f} s: the truth's integrator failed", s.time_s));
    text += fmt::format("{:.3f},{:.6f},{:.9f}", s.time_s, s.torque_cmd_Nm, s.position_m);
    if (channels & scale) text += fmt::format(",{:.9f}", s.scale_position_m);
    if (channels & torque_sensor) text += fmt::format(",{:.5f}", s.torque_sensor_Nm);
    if (channels & force_sensor) text += fmt::format(",{:.4f}", s.force_sensor_N);
    if (channels & power) text += fmt::format(",{:.4f}", s.power_W);
    text += '\n';
  }
  return text;
}

std::string file_list(const std::vector<NamedRun>& runs) {
  std::string text;
  for (const auto& run : runs) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", run.file);
  return text;
}

nlohmann::json key_of(const Case& c, std::uint64_t seed) {
  const bool in_torque = std::ranges::any_of(c.hidden, [](const Hidden* h) { return h->seen_in_torque; });
  nlohmann::json key = {{"seed", seed},
                        {"kind", c.kind},
                        {"effects", nlohmann::json::object()},
                        {"friction", c.truth.maxwell_slip ? "maxwell_slip" : "lugre"},
                        {"coupling_N_per_m", c.truth.coupling_N_per_m},
                        {"wrong_by", c.wrong_by},
                        {"masked", c.masked},
                        {"disturbance_N", c.noise.disturbance_N},
                        {"residual_N", c.residual_N},
                        {"effect_N", c.effect_N},
                        {"strength", in_torque ? c.effect_N / c.residual_N : 0.0}};
  std::vector<std::string> tolerated;
  if (c.truth.maxwell_slip) tolerated.push_back("presliding_memory");  // it is there: the nominal model has one bristle
  if (c.truth.coupling_N_per_m > 0.0) tolerated.push_back("screw_compliance");
  nlohmann::json alike = nlohmann::json::object();
  bool number_only = !c.hidden.empty();
  bool alone = true;
  for (const Hidden* h : c.hidden) {
    if (c.kind == "outside") {
      key["outside"] = h->id;
      continue;
    }
    auto& numbers = key["effects"][h->id] = nlohmann::json::object();
    for (const auto& [name, value] : h->numbers(c.effects)) numbers[name] = value;
    if (h->id == "screw_compliance") numbers["stiffness_N_per_m"] = c.truth.coupling_N_per_m;
    if (!h->alike.empty()) alike[h->id] = h->alike;
    number_only = number_only && h->number_only;
    alone = alone && identifiable(*h, c.channels);
  }
  auto& held_out = key["holdout"] = nlohmann::json::object();
  for (const auto& one : c.floors) held_out[one.channel] = {{"noise_floor", one.floor}, {"effect", one.effect}};
  key["alike"] = alike;
  key["identifiable"] = alone;
  key["tolerated"] = tolerated;
  key["number_only"] = number_only && c.kind != "outside";
  return key;
}

}  // namespace

void write_case(const Case& c, std::uint64_t seed, const std::string& folder, const std::string& key_file) {
  const std::filesystem::path path(folder);
  std::filesystem::create_directories(path);
  write_text(path / "axis.toml", axis_text(c.nominal));
  write_text(path / "case.toml", fmt::format("axis = \"axis.toml\"\nfit = [{}]\nholdout = [{}]\nsample_rate_Hz = 1000\n",
                                             file_list(c.fit), file_list(c.holdout)));
  for (const auto* runs : {&c.fit, &c.holdout})
    for (const auto& named : *runs) write_text(path / named.file, run_text(named.run, c.channels));
  std::filesystem::create_directories(std::filesystem::path(key_file).parent_path());
  write_text(key_file, key_of(c, seed).dump(2) + "\n");
}

}  // namespace feedtwin::challenge
