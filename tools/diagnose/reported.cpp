#include "tools/diagnose/reported.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/own_phase.h"
#include "tools/diagnose/sentence.h"
#include "tools/diagnose/windows.h"
#include "tools/intervals.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// Where in the list of unknowns an effect's working parameters stand; -1 for those that are not fitted.
std::vector<Index> places_of(const Fit& fit, std::size_t effect) {
  Index at = fit.base_count();
  std::vector<Index> places;
  for (std::size_t e = 0; e <= effect; ++e) {
    const auto& active = fit.model.effects[e];
    places.assign(active.q.size(), -1);
    for (std::size_t j = 0; j < active.q.size(); ++j)
      if (fitted(active.hypothesis->parameters[j].kind)) places[j] = at++;
  }
  return places;
}

/// Does this value rest on what is no finding of its own?
bool hidden(const Active& active, const plant::AxisParameters& axis, std::size_t value) {
  for (std::size_t j = 0; j < active.q.size(); ++j) {
    if (active.hypothesis->parameters[j].kind != Kind::simulated) continue;
    auto near = active.q;
    near[j] += active.hypothesis->parameters[j].step;
    if (active.hypothesis->named(near, axis)[value].value != active.hypothesis->named(active.q, axis)[value].value)
      return true;
  }
  return false;
}

/// A line has a phase in each of several runs, and of those that are not there nothing is known.
bool of_no_run(const Active& active, std::size_t parameter) {
  return active.hypothesis->line_of != nullptr && parameter < 2 * line_runs && !has_line(active.q, parameter / 2);
}

/// Intervals of what is reported, from the covariance of what was fitted.
std::vector<std::pair<std::string, Estimate>> estimates(const Fit& fit, const Eigen::MatrixXd& covariance,
                                                        std::size_t effect) {
  const auto& active = fit.model.effects[effect];
  const auto& axis = fit.model.axis;
  const auto places = places_of(fit, effect);
  const auto now = active.hypothesis->named(active.q, axis);
  std::vector<std::pair<std::string, Estimate>> out;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (hidden(active, axis, i)) continue;
    Vector slope = Vector::Zero(covariance.rows());
    bool is_a_size = false;
    for (std::size_t j = 0; j < active.q.size(); ++j) {
      if (places[j] < 0 || of_no_run(active, j)) continue;
      const double sigma = std::sqrt(std::max(0.0, covariance(places[j], places[j])));
      const double step = 1e-3 * std::max(sigma, 1e-6 * std::abs(active.q[j])) + 1e-300;
      auto near = active.q;
      near[j] += step;
      slope[places[j]] = (active.hypothesis->named(near, axis)[i].value - now[i].value) / step;
      is_a_size |= active.hypothesis->parameters[j].kind == Kind::amplitude && slope[places[j]] != 0.0;
    }
    const double by_law = is_a_size ? active.hypothesis->law_error * now[i].value : 0.0;
    const double sigma = std::sqrt(std::max(0.0, slope.dot(covariance * slope)));
    if (sigma > 1e3 * (std::abs(now[i].value) + 1e-9)) continue;  // of a channel that is not there
    const double half = normal_90 * std::hypot(for_the_laws * sigma, by_law);
    out.push_back({now[i].name, {now[i].value, now[i].value - half, now[i].value + half}});
  }
  return out;
}

std::vector<std::pair<double, double>> acts_in(const NamedEffect& effect, const InverseModel& model) {
  double low = 1e300, high = -1e300;
  const auto cover = [&](double a, double b) { low = std::min(low, a), high = std::max(high, b); };
  for (const auto& track : model.tracks()) {
    switch (effect.hypothesis->where) {
      case Where::position:
        cover(track.position_m.minCoeff(), track.position_m.maxCoeff());
        break;
      case Where::velocity:
        cover(track.centred_m_per_s.minCoeff(), track.centred_m_per_s.maxCoeff());
        break;
      case Where::reversal:
        cover(0.0, about_a_reversal_s);
        break;
      default:
        cover(0.0, static_cast<double>(track.size) * track.sample_s);
    }
  }
  for (const auto& [name, estimate] : effect.parameters)
    if (name == "cycles_per_rev" || name == "frequency_Hz") return {{estimate.value, estimate.value}};
  return {{low, high}};
}

std::string parts_of_runs(const Active& active) {
  std::string parts;
  for (std::size_t run = 0; run < line_runs; ++run) {
    std::string of_run;
    for (const Window& window : windows_of_run(active.hypothesis->first_window, active.q, run))
      of_run += fmt::format("{}{:.3g} to {:.3g} s", of_run.empty() ? "" : " and ", window.start_s, window.end_s);
    if (!of_run.empty()) parts += (parts.empty() ? "" : ", ") + of_run;
  }
  return fmt::format(" It acts in a part of a run alone: {}; a held-out run's is taken from that run.", parts);
}

}  // namespace

std::vector<Recalibrated> recalibrated(const Fitter& fitter, const Fit& fit, const Eigen::MatrixXd& covariance) {
  std::vector<Recalibrated> out;
  for (std::size_t i = 0; i < fitter.base().size(); ++i) {
    const auto& parameter = fitter.base()[i];
    const double was = value_of(parameter, fitter.nominal()), now = value_of(parameter, fit.model.axis);
    const auto at = static_cast<Index>(i);
    const double in_tolerances = std::sqrt(std::max(0.0, covariance(at, at)));
    const double sigma = in_tolerances * fitter.tolerance(i);
    const bool told_by_data = in_tolerances < 0.5;
    if (told_by_data && std::abs(now - was) > 3.0 * sigma && std::abs(now - was) > 2e-3 * std::abs(was))
      out.push_back({std::string(parameter.entry->key), was, {now, now - normal_90 * sigma, now + normal_90 * sigma}});
  }
  return out;
}

NamedEffect held_by_numbers(const Hypothesis& name, double gain, const Fit& fit) {
  NamedEffect effect;
  effect.hypothesis = &name;
  effect.component = name.component;
  effect.channel = name.channel;
  effect.share = gain / (gain + fit.cost);
  effect.p_false_alarm = std::min(1.0, std::exp(-0.5 * gain) * static_cast<double>(hypotheses().size()));
  return effect;
}

NamedEffect named_effect(const Found& one, const Fit& fit, const Eigen::MatrixXd& covariance, const InverseModel& model) {
  NamedEffect effect;
  effect.hypothesis = one.effect.hypothesis;
  effect.component = component_of(one.effect, fit.model.axis);
  effect.channel = channel_of(one.effect);
  for (std::size_t e = 0; e < fit.model.effects.size(); ++e)
    if (fit.model.effects[e].hypothesis == one.effect.hypothesis) effect.parameters = estimates(fit, covariance, e);
  effect.share = one.share;
  effect.p_false_alarm = one.p_false_alarm;
  effect.by_closed_loop = one.by_closed_loop;
  effect.by_common_shift = one.by_common_shift;
  effect.intervals = acts_in(effect, model);
  for (const auto* rival : one.rivals) {  // another law of the same physics is none
    const bool told = std::ranges::find(effect.alternatives, told_id(*rival)) != effect.alternatives.end();
    if (!told && told_id(*rival) != told_id(*effect.hypothesis)) effect.alternatives.emplace_back(told_id(*rival));
  }
  const auto now = std::ranges::find(fit.model.effects, effect.hypothesis, &Active::hypothesis);
  const auto beside = std::string(effect.hypothesis->always_beside);
  const bool far = !beside.empty() && told_by_size_alone(*now);
  if (!beside.empty() && !far && std::ranges::find(effect.alternatives, beside) == effect.alternatives.end())
    effect.alternatives.push_back(beside);
  effect.sentence = sentence_of(effect);
  if (far) effect.sentence += fmt::format(" Only its size tells it from {}, which obeys the same equation.", beside);
  if (effect.hypothesis->line_of != nullptr)
    effect.sentence += phases_agree(*now) ? " All runs share its phase."
                                          : " Each run has a phase of its own; a held-out run's is taken from that run.";
  if (windowed(*now)) effect.sentence += parts_of_runs(*now);
  if (!effect.hypothesis->state.empty() && states_differ(*now)) {
    const auto [low, high] = states_from_to(*now);
    effect.sentence += fmt::format(
        " Each run begins as what was before has left it, from {:.2g} to {:.2g} of that; a held-out "
        "run's is taken from that run.",
        low, high);
  }
  return effect;
}

}  // namespace feedtwin::tools::diagnosis
