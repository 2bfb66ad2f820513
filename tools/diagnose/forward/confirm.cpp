#include "tools/diagnose/forward/confirm.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/ruling.h"
#include "tools/diagnose/torque_by_power.h"

namespace feedtwin::tools::diagnosis {

Confirmation confirm(const ForwardModel& forward, const Fitter& fitter, const Whitening& whitening, const Candidate& model,
                     std::size_t effect) {
  constexpr int iterations = 6;
  Confirmation found;
  found.without = fitter.fit(without(model, effect), whitening, iterations);  // its numbers may take up what they can
  const auto with = forward.nrmse(extended(model)), less = forward.nrmse(extended(found.without.model));
  for (const auto& [channel, error] : with)
    if (error > 0.0 && bears_out(model.effects[effect], channel) && less.at(channel) > found.error_ratio * error)
      found.channel = channel, found.error_ratio = less.at(channel) / error;
  return found;
}

bool asked_once_polished(const Found& named) {
  return named.held_everywhere && named.error_ratio >= named.effect.hypothesis->least_error_ratio_polished;
}

namespace {

/// Times as far off as with it, without it.
double least_error_ratio(const Active& effect, const std::vector<Track>& runs) {
  const Hypothesis& h = *effect.hypothesis;
  return h.shown != nullptr && h.shown(runs, effect.q) ? usual_error_ratio : h.least_error_ratio;
}

/// Numbers of the inverse model may simulate so badly that no name's absence shows. Where all that was not seen bears a name
/// out, both go on from there in closed loop before it goes: right names then had 221 nats and 3.3 deviations and more,
/// false ones -4354 to 1 and 0.8.
bool missed_once_polished(const ForwardModel& forward, const Fitter& fitter, const Found* named, const Fit& with,
                          const Fit& without, const std::function<void(std::string_view)>& progress) {
  if (named == nullptr || !asked_once_polished(*named)) return false;
  Ruling one = rule(with, forward, fitter), rest = rule_beside(one, without, forward, fitter, SlopesOf::anew);
  contest(one, rest, forward, fitter);
  const double nats = one.value - rest.value, deviations = compared(one.likelihood, rest.likelihood).deviations;
  progress(fmt::format("closed loop, both polished, with {}: {:+.0f} nats, {:+.1f} deviations", named->effect.hypothesis->id,
                       nats, deviations));
  return nats > clearly_nats && deviations > clearly_deviations;
}

}  // namespace

void keep_confirmed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                    const std::function<void(std::string_view)>& progress) {
  const auto drop = [&](std::size_t e, Fit without) {
    std::erase_if(found.found, [&](const Found& one) { return one.effect.hypothesis == fit.model.effects[e].hypothesis; });
    fit = std::move(without);
  };
  for (std::size_t e = fit.model.effects.size(); e-- > 0;) {
    const auto* hypothesis = fit.model.effects[e].hypothesis;
    if (!worth_naming(fit.model.effects[e], fit.model.axis) || hypothesis->number_of_the_model) continue;
    if (denied_by_power(fitter, fit.model, e)) {
      progress(
          fmt::format("{}: the power that was measured says otherwise", in_words(fit.model.effects[e], fit.model.axis)));
      drop(e, fitter.fit(without(fit.model, e), found.whitening, refit_iterations));
      continue;
    }
    if (const auto* named = found.of(hypothesis); named != nullptr && (named->by_closed_loop || named->far_off)) continue;
    auto seen = confirm(forward, fitter, found.whitening, fit.model, e);
    progress(fmt::format("closed loop without {}: {} off by {:.4f} times as much", hypothesis->id,
                         seen.channel.empty() ? "no channel" : seen.channel, seen.error_ratio));
    if (auto* named = found.of(hypothesis)) named->error_ratio = seen.error_ratio;
    if (seen.error_ratio > least_error_ratio(fit.model.effects[e], fitter.model().tracks())) continue;
    if (missed_once_polished(forward, fitter, found.of(hypothesis), fit, seen.without, progress)) continue;
    drop(e, std::move(seen.without));
  }
}

}  // namespace feedtwin::tools::diagnosis
