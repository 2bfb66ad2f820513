#include "tools/diagnose/forward/missed.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double in_question_nats = 1000.0;
constexpr int iterations = 6;

/// What it takes to stay. A name that the inverse model asks for and unseen folds bear out goes where it is in the way: of
/// those on made cases that were wrong the runs were likelier without by 115 and 157, of the right ones none; friction along
/// the stroke of the EMPS axis, which its unseen laps bear out, by 22.
double least_nats(const Found& named) {
  return std::max(named.by_closed_loop ? 100.0 : -50.0, named.effect.hypothesis->least_missed_nats);
}

/// A name that does not stay, and the runs without it.
struct Lacking {
  const Hypothesis* hypothesis;
  Ruling rest;
  double short_of_nats;  ///< what it would take to stay
};

/// Asks every name, and notes the answers.
std::optional<Lacking> least_missed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, const Fit& fit,
                                    const Ruling& settled, const std::function<void(std::string_view)>& progress) {
  std::optional<Lacking> least;
  for (std::size_t e = 0; e < fit.model.effects.size(); ++e) {
    const auto* hypothesis = fit.model.effects[e].hypothesis;
    auto* named = found.of(hypothesis);
    if (named == nullptr || !worth_naming(fit.model.effects[e])) continue;
    const Fit less = fitter.fit(without(fit.model, e), found.whitening, iterations);
    Ruling rest = rule_beside(settled, less, forward, fitter, SlopesOf::before);
    if (settled.value - rest.value < in_question_nats) rest = rule_again(rest, forward, fitter, SlopesOf::anew);
    named->missed_nats = settled.value - rest.value;
    progress(fmt::format("closed loop, all numbers free, without {}: {:+.0f} nats", hypothesis->id, -named->missed_nats));
    const double short_of_nats = least_nats(*named) - named->missed_nats;
    if (short_of_nats > 0.0 && (!least || short_of_nats > least->short_of_nats))
      least = Lacking{hypothesis, std::move(rest), short_of_nats};
  }
  return least;
}

}  // namespace

void keep_missed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit, Ruling& settled,
                 const std::function<void(std::string_view)>& progress) {
  for (;;) {
    auto least = least_missed(forward, fitter, found, fit, settled, progress);
    if (!least) return;
    progress(fmt::format("closed loop: {} is not missed", least->hypothesis->id));
    std::erase_if(found.found, [&](const Found& one) { return one.effect.hypothesis == least->hypothesis; });
    settled = std::move(least->rest);
    fit = settled.fit;
  }
}

}  // namespace feedtwin::tools::diagnosis
