#include "tools/diagnose/forward/missed.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double least_nats = 30.0, in_question_nats = 1000.0;
constexpr int iterations = 6;

/// A name and the runs without it.
struct Lacking {
  const Hypothesis* hypothesis;
  Ruling rest;
};

/// Asks every name, and notes the answers.
std::optional<Lacking> least_missed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, const Fit& fit,
                                    const Ruling& settled, const std::function<void(std::string_view)>& progress) {
  std::optional<Lacking> least;
  for (std::size_t e = 0; e < fit.model.effects.size(); ++e) {
    if (!worth_naming(fit.model.effects[e])) continue;
    const auto* hypothesis = fit.model.effects[e].hypothesis;
    const Fit less = fitter.fit(without(fit.model, e), found.whitening, iterations);
    Ruling rest = rule_beside(settled, less, forward, fitter, SlopesOf::before);
    if (settled.value - rest.value < in_question_nats) rest = rule_again(rest, forward, fitter, SlopesOf::anew);
    progress(
        fmt::format("closed loop, all numbers free, without {}: {:+.0f} nats", hypothesis->id, rest.value - settled.value));
    for (auto& named : found.found)
      if (named.effect.hypothesis == hypothesis) named.missed_nats = settled.value - rest.value;
    if (!least || rest.value > least->rest.value) least = Lacking{hypothesis, std::move(rest)};
  }
  return least;
}

}  // namespace

void keep_missed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit, Ruling& settled,
                 const std::function<void(std::string_view)>& progress) {
  for (;;) {
    auto least = least_missed(forward, fitter, found, fit, settled, progress);
    if (!least || settled.value - least->rest.value > least_nats) return;
    progress(fmt::format("closed loop: {} is not missed", least->hypothesis->id));
    std::erase_if(found.found, [&](const Found& one) { return one.effect.hypothesis == least->hypothesis; });
    settled = std::move(least->rest);
    fit = settled.fit;
  }
}

}  // namespace feedtwin::tools::diagnosis
