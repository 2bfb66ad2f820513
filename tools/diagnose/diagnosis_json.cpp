#include "tools/diagnose/diagnosis_json.h"

#include <nlohmann/json.hpp>

namespace feedtwin::tools::diagnosis {
namespace {

using nlohmann::json;

const char* name_of(Where where) {
  switch (where) {
    case Where::position:
      return "position";
    case Where::velocity:
      return "velocity";
    case Where::time:
      return "time";
    case Where::reversal:
      return "reversal";
    case Where::order:
      return "order";
    default:
      return "frequency";
  }
}

json of(const Estimate& estimate) {
  return {{"value", estimate.value}, {"ci90", {estimate.low, estimate.high}}};
}

json of(const std::map<std::string, ChannelFigures>& channels) {
  json out = json::object();
  for (const auto& [channel, f] : channels)
    out[channel] = {{"nrmse_before", f.before},
                    {"nrmse_recalibrated", f.recalibrated},
                    {"nrmse_after", f.after},
                    {"noise_floor", f.floor}};
  return out;
}

json of(const NamedEffect& effect) {
  json parameters = json::object(), intervals = json::array();
  for (const auto& [name, estimate] : effect.parameters) parameters[name] = of(estimate);
  for (const auto& [low, high] : effect.intervals) intervals.push_back({low, high});
  const auto& h = *effect.hypothesis;
  return {{"id", told_id(h)},
          {"component", effect.component},
          {"sentence", effect.sentence},
          {"where", {{"channel", effect.channel}, {"axis", name_of(h.where)}, {"intervals", intervals}}},
          {"parameters", parameters},
          {"share_of_mismatch", effect.share},
          {"p_false_alarm", effect.p_false_alarm}};
}

json of(const ReadingStructure& reading) {
  json out = {{"channel", reading.channel},
              {"follows", what_it_follows(reading)},
              {"remainder", reading.remainder},
              {"share_unseen", reading.share},
              {"in_updated_axis", reading.in_plant}};
  if (reading.every > 0.0) out["every"] = reading.every;
  return out;
}

}  // namespace

json to_json(const Diagnosis& diagnosis, const std::string& updated_axis) {
  json out;
  out["verdict"] = diagnosis.verdict;
  out["summary"] = diagnosis.summary;
  out["effects"] = json::array();
  out["alternatives"] = json::array();
  for (const auto& fault : diagnosis.setup) {
    json parameters = json::object();
    for (const auto& [name, value, half] : fault.parameters)
      parameters[name] = {{"value", value}, {"ci90", {value - half, value + half}}};
    out["effects"].push_back({{"id", fault.id},
                              {"component", fault.component},
                              {"sentence", fault.sentence},
                              {"where", {{"channel", fault.channel}, {"axis", "time"}, {"intervals", json::array()}}},
                              {"parameters", parameters},
                              {"share_of_mismatch", 1.0},
                              {"p_false_alarm", 0.0}});
  }
  if (diagnosis.unknown)
    out["unknown"] = {{"axis", name_of(diagnosis.unknown->axis)},
                      {"interval", {diagnosis.unknown->low, diagnosis.unknown->high}},
                      {"remainder_N", diagnosis.unknown->remainder_N},
                      {"share_unseen", diagnosis.unknown->share_unseen}};
  if (diagnosis.unknown && diagnosis.unknown->mode)
    out["unknown"]["mode"] = {{"mass_kg", diagnosis.unknown->mode->mass_kg},
                              {"frequency_Hz", diagnosis.unknown->mode->frequency_Hz},
                              {"damping_ratio", diagnosis.unknown->mode->damping_ratio}};
  if (diagnosis.unknown && diagnosis.unknown->sweep)
    out["unknown"]["sweep"] = {{"rate_Hz_per_s", diagnosis.unknown->sweep->rate_Hz_per_s},
                               {"amplitude_N", diagnosis.unknown->sweep->amplitude_N}};
  if (diagnosis.unknown && diagnosis.unknown->dropouts)
    out["unknown"]["dropouts"] = {{"share_of_torque", diagnosis.unknown->dropouts->share},
                                  {"moments", diagnosis.unknown->dropouts->moments}};
  if (diagnosis.unknown && diagnosis.unknown->switching)
    out["unknown"]["switching"] = {{"force_N", diagnosis.unknown->switching->force_N},
                                   {"opposes_motion", diagnosis.unknown->switching->opposes},
                                   {"share", diagnosis.unknown->switching->share},
                                   {"switches", diagnosis.unknown->switching->switches}};
  if (diagnosis.unknown_reading) out["unknown"] = of(*diagnosis.unknown_reading);
  for (const auto& effect : diagnosis.effects) {
    out["effects"].push_back(of(effect));
    if (effect.alternatives.empty()) continue;
    json set = {told_id(*effect.hypothesis)};
    for (const auto& other : effect.alternatives) set.push_back(other);
    out["alternatives"].push_back(set);
  }
  out["recalibrated"] = json::object();
  for (const auto& one : diagnosis.recalibrated)
    out["recalibrated"][one.key] = {{"was", one.was}, {"now", one.now.value}, {"ci90", {one.now.low, one.now.high}}};
  if (diagnosis.motor_presliding_m > 0.0) out["motor_presliding_m"] = diagnosis.motor_presliding_m;
  out["simulated_samples"] = diagnosis.simulated_samples;
  if (diagnosis.cut_short) out["cut_short"] = true;
  if (diagnosis.power_of_command) out["power_of_command"] = true;
  out["holdout"] = of(diagnosis.holdout);
  out["holdout_inverse_model"] = of(diagnosis.holdout_inverse);
  out["force_error_inverse_model"] = {{"before", diagnosis.force_error.before},
                                      {"recalibrated", diagnosis.force_error.recalibrated},
                                      {"after", diagnosis.force_error.after}};
  out["energy"] = json::object();
  for (const auto& [component, before] : diagnosis.energy_before)
    out["energy"][component] = {{"before_J", before}, {"after_J", diagnosis.energy_after.at(component)}};
  out["next_experiment"] = {{"move", diagnosis.next.move}, {"separates", diagnosis.next.separates}, {"p_resolve", nullptr}};
  if (diagnosis.next.p_resolve) out["next_experiment"]["p_resolve"] = *diagnosis.next.p_resolve;
  out["suspects"] = json::array();
  for (const auto& s : diagnosis.suspects)
    out["suspects"].push_back(
        {{"id", told_id(*s.hypothesis)}, {"strength", s.strength}, {"p_false_alarm", s.p_false_alarm}});
  if (diagnosis.denied_by_unseen > 0.0) out["denied_by_unseen"] = diagnosis.denied_by_unseen;
  if (diagnosis.numbers_denied_by_unseen > 0.0) out["numbers_denied_by_unseen"] = diagnosis.numbers_denied_by_unseen;
  out["detection_limit_N"] = diagnosis.detection_limit_N;
  out["updated_axis"] = updated_axis;
  out["figures"] = tools::to_json(diagnosis.pictures);
  return out;
}

json to_json(const HilComparison& hil) {
  json channels = json::object();
  for (const auto& [channel, before] : hil.before.nrmse)
    channels[channel] = {{"nrmse_before", before}, {"nrmse_after", hil.after.nrmse.at(channel)}};
  const auto of_run = [](const HilRun& run) {
    return json{
        {"ticks", run.ticks}, {"missed_ticks", run.missed_ticks}, {"verdict", run.verdict}, {"delay_s", run.delay_s}};
  };
  return {{"recording", hil.recording},
          {"duration_s", hil.duration_s},
          {"channels", channels},
          {"before", of_run(hil.before)},
          {"after", of_run(hil.after)}};
}

}  // namespace feedtwin::tools::diagnosis
