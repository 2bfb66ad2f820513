#include "tools/diagnose/whole_number.h"

#include <algorithm>
#include <utility>

#include "tools/diagnose/judge.h"

namespace feedtwin::tools::diagnosis {

Fit fit_with_whole_number(const Fitter& fitter, const Fit& without, Score more, const Whitening& whitening, const Bar& bar,
                          int iterations) {
  constexpr double clearly = 1.2;  // times as much: of two that hold alike the screen's stays
  const auto refit = [&] {
    return fit_with(fitter, without.model, more, without.model.effects.size(), whitening, iterations);
  };
  const auto foretold = [&](const Fit& fit) {
    const auto verdict = judged(fitter, fit, without, *more.hypothesis, bar);
    return on_unseen(fitter.model(), fit, without, *more.hypothesis, verdict, bar).gain;
  };
  Fit best = refit();
  if (more.also.empty()) return best;
  double most = foretold(best);
  for (const auto& q : std::exchange(more.also, {})) {
    more.q = q;
    Fit other = refit();
    if (const double gain = foretold(other); gain > clearly * std::max(0.0, most)) best = std::move(other), most = gain;
  }
  return best;
}

}  // namespace feedtwin::tools::diagnosis
