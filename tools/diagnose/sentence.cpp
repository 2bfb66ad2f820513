#include "tools/diagnose/sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace feedtwin::tools::diagnosis {
namespace {

std::string told(const Estimate& estimate) {
  if (estimate.high - estimate.low < 1e-9 * std::abs(estimate.value)) return fmt::format("{:.4g}", estimate.value);
  return fmt::format("{:.4g} ({:.4g} to {:.4g})", estimate.value, estimate.low, estimate.high);
}

std::string how_much(const NamedEffect& effect) {
  if (effect.by_common_shift)
    return "The table's numbers could make up for it, mass and all friction off by the same share; that numbers which are "
           "known each by itself should be tells it from them";
  if (effect.by_closed_loop)
    return "Other numbers of the model can imitate its force; the simulated motion tells it from them";
  return fmt::format("It makes {:.0f} % of what the recalibrated model leaves over", 100.0 * effect.share);
}

/// Of a tool that cuts one way alone.
std::string which_way(const NamedEffect& effect) {
  const double only = value_of(effect, "only_direction");
  if (only == 0.0) return "";
  return fmt::format(" It acts while the table moves in {} direction and not on the way back.",
                     only > 0.0 ? "positive" : "negative");
}

/// Every {slot} of the text.
void fill_in(std::string& text, std::string_view slot, const std::string& words) {
  const std::string held = fmt::format("{{{}}}", slot);
  for (auto at = text.find(held); at != std::string::npos; at = text.find(held)) text.replace(at, held.size(), words);
}

std::string list_of(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

double value_of(const NamedEffect& effect, std::string_view name) {
  const auto found = std::ranges::find(effect.parameters, name, &std::pair<std::string, Estimate>::first);
  return found == effect.parameters.end() ? 0.0 : found->second.value;
}

std::string sentence_of(const NamedEffect& effect) {
  std::string text(effect.hypothesis->sentence);
  fill_in(text, "contact", effect.component == "guide" ? "guide" : "screw");
  for (const auto& [name, estimate] : effect.parameters) fill_in(text, name, told(estimate));
  for (auto at = text.find('{'); at != std::string::npos; at = text.find('{'))
    text.replace(at, text.find('}', at) + 1 - at, "(not told by these data)");
  text = fmt::format("{}: {}. {}; chance of a false alarm over all hypotheses {:.1g}.", effect.component, text,
                     how_much(effect), std::max(1e-6, effect.p_false_alarm));
  text += which_way(effect);
  std::vector<std::string> ruled_out;
  for (const auto other : effect.hypothesis->confused_with)
    if (other != told_id(*effect.hypothesis) && std::ranges::find(effect.alternatives, other) == effect.alternatives.end())
      ruled_out.emplace_back(other);
  if (!effect.alternatives.empty())
    text += fmt::format(" These channels cannot tell it from {}.", list_of(effect.alternatives));
  if (!ruled_out.empty()) text += fmt::format(" Ruled out, because they explain less: {}.", list_of(ruled_out));
  return text;
}

std::string next_move_of(const NextExperiment& next) {
  if (next.move.empty()) return "";
  if (!next.p_resolve) return fmt::format(" What would tell: {}.", next.move);
  return fmt::format(" Of the moves tried in simulation this one tells best: {}; chance that it does {:.0f} %.", next.move,
                     100.0 * *next.p_resolve);
}

namespace {

std::string how_it_runs(const std::optional<Mode>& mode) {
  if (!mode) return "The updated axis does not hold it: in closed loop it comes no closer.";
  return fmt::format("The updated axis holds it (learned_mode): {:.3g} kg at {:.4g} Hz, damping ratio {:.2g}.",
                     mode->mass_kg, mode->frequency_Hz, mode->damping_ratio);
}

std::vector<std::string> ids_of(const std::vector<Suspect>& suspects) {
  std::vector<std::string> ids;
  for (const auto& suspect : suspects) ids.emplace_back(told_id(*suspect.hypothesis));
  return ids;
}

std::string in_words(const ReadingStructure& reading) {
  const bool commanded = reading.channel == channel::torque_cmd_Nm;
  return fmt::format(
      "The mismatch is real and none of the known effects explains it: {} is {:.2g} rms off in its unit, and {:.0f} % of "
      "that follows {}, on seconds that it was not learned from. {} The updated axis {}.",
      reading.channel, reading.remainder, 100.0 * reading.share, what_it_follows(reading),
      commanded ? "What acts is not what was commanded." : "The channel shows it; the axis does not do it.",
      reading.in_plant ? fmt::format("has a table of it ({}) that holds {:.0f} %",
                                     commanded ? "learned_command" : "learned_reading", 100.0 * reading.table->share_unseen)
                       : "does not hold it: no table of it brings the runs closer");
}

std::string outcome_of(const Diagnosis& diagnosis) {
  const auto& verdict = diagnosis.verdict;
  if (verdict == "agrees" && diagnosis.numbers_denied_by_unseen > 0.0)
    return fmt::format("Nothing is missing that could be named; an effect of {:.2g} N rms would have been.",
                       diagnosis.detection_limit_N);
  if (verdict == "agrees")
    return fmt::format("Model and recording agree; an effect of {:.2g} N rms would have been named.",
                       diagnosis.detection_limit_N);
  if (verdict == "recalibrate" && diagnosis.effects.empty())
    return fmt::format("{} numbers of the model are off; no physics is missing beyond {:.2g} N rms.",
                       diagnosis.recalibrated.size(), diagnosis.detection_limit_N);
  if (verdict == "unknown" && diagnosis.unknown_reading) return in_words(*diagnosis.unknown_reading);
  if (verdict == "unknown" && diagnosis.unknown->sweep)
    return fmt::format(
        "The mismatch is real and none of the known effects explains it: {:.2g} N rms, most of it a force of {:.2g} N whose "
        "frequency runs from {:.3g} to {:.3g} Hz, by {:+.2g} Hz a second, whatever the axis does. The updated axis does not "
        "hold it: when it begins no run says of another.",
        diagnosis.unknown->remainder_N, diagnosis.unknown->sweep->amplitude_N, diagnosis.unknown->low,
        diagnosis.unknown->high, diagnosis.unknown->sweep->rate_Hz_per_s);
  if (verdict == "unknown" && diagnosis.unknown->dropouts)
    return fmt::format(
        "The mismatch is real and none of the known effects explains it: at {} moments, some milliseconds each, the axis "
        "lacks {:.0f} % of the commanded torque. The drive does not give there what it is told to. The updated axis does "
        "not hold it: when it comes no run says of another.",
        diagnosis.unknown->dropouts->moments, 100.0 * diagnosis.unknown->dropouts->share);
  if (verdict == "unknown" && diagnosis.unknown->switching)
    return fmt::format(
        "The mismatch is real and none of the known effects explains it: a force of {:.3g} N{} is on or off, with hardly "
        "anything between ({:.0f} % of what is left over); {} switches were seen. The updated axis "
        "does not hold it: when it comes no run says of another.",
        diagnosis.unknown->switching->force_N, diagnosis.unknown->switching->opposes ? " against the motion" : "",
        100.0 * diagnosis.unknown->switching->share, diagnosis.unknown->switching->switches);
  if (verdict == "unknown" && diagnosis.unknown->axis == Where::frequency)
    return fmt::format(
        "The mismatch is real and none of the known effects explains it: {:.2g} N rms, of which a part that swings on a "
        "light "
        "damper at {:.3g} to {:.3g} Hz, set off by the axis' acceleration, explains {:.0f} % on stretches that it was not "
        "fitted to. {}",
        diagnosis.unknown->remainder_N, diagnosis.unknown->low, diagnosis.unknown->high,
        100.0 * diagnosis.unknown->share_unseen, how_it_runs(diagnosis.unknown->mode));
  if (verdict == "unknown")
    return fmt::format(
        "The mismatch is real and none of the known effects explains it: {:.2g} N rms{}, of which a table over {} explains "
        "{:.0f} % on runs that it was not learned from; it acts mostly from {:.4g} to {:.4g}.",
        diagnosis.unknown->remainder_N, diagnosis.unknown->on_the_table ? " on the table, behind its force sensor" : "",
        !diagnosis.unknown->damping_pos_Ns_per_m.empty() ? "position (m), of a force and a damping,"
        : diagnosis.unknown->axis == Where::position     ? "position (m)"
        : diagnosis.unknown->axis == Where::velocity     ? "speed (m/s)"
                                                         : "time since reversal (s)",
        100.0 * diagnosis.unknown->share_unseen, diagnosis.unknown->low, diagnosis.unknown->high);
  if (verdict == "cannot-tell") {
    if (diagnosis.denied_by_unseen > 0.0) return "Something is left over that cannot be named.";
    return fmt::format(
               "Something is left over that chance does not explain (p {:.1g}) and that is too weak to be named: it would "
               "have "
               "to make {:.2g} N rms. It looks most like {}.",
               std::max(1e-6, diagnosis.suspects.front().p_false_alarm), diagnosis.detection_limit_N,
               list_of(ids_of(diagnosis.suspects))) +
           next_move_of(diagnosis.next);
  }
  std::vector<std::string> ids;
  for (const auto& fault : diagnosis.setup) ids.push_back(fault.id);
  for (const auto& effect : diagnosis.effects) ids.emplace_back(told_id(*effect.hypothesis));
  return fmt::format("{}: {}.", verdict == "recalibrate" ? "A number of the model is wrong" : "Missing from the model",
                     list_of(ids));
}

}  // namespace

std::string summary_of(const Diagnosis& diagnosis) {
  std::string text = outcome_of(diagnosis);
  if (diagnosis.denied_by_unseen > 0.0)
    text += fmt::format(
        " What had been found for it ({}) leaves runs that were not fitted {:.1f} times as far off as the recalibrated "
        "numbers alone: it stands for something else, and is not named.",
        list_of(ids_of(diagnosis.suspects)), diagnosis.denied_by_unseen);
  if (diagnosis.numbers_denied_by_unseen > 0.0)
    text += fmt::format(
        " Numbers that the fitted runs ask for leave runs that were not fitted {:.2f} times as far off as the file's own, "
        "which the updated axis keeps.",
        diagnosis.numbers_denied_by_unseen);
  if (diagnosis.motor_presliding_m > 0.0)
    text += fmt::format(
        " The motor's friction sets in over about {:.2g} um after each reversal, not at once: so it does in the updated "
        "axis.",
        1e6 * diagnosis.motor_presliding_m);
  if (diagnosis.cut_short)
    text += " The closed loop has simulated as much as it may: what it would still have asked is left out.";
  if (diagnosis.power_of_command)
    text +=
        " The power is, to a thousandth, what commanded torque and motion make: a figure that the drive computes, which "
        "tells nothing of what acts between command and shaft.";
  return text;
}

}  // namespace feedtwin::tools::diagnosis
