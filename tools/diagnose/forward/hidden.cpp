#include "tools/diagnose/forward/hidden.h"

#include <set>

#include "tools/diagnose/forward/confirm.h"

namespace feedtwin::tools::diagnosis {

bool name_what_they_hid(const std::vector<Active>& before, const ForwardModel& forward, const Fitter& fitter,
                        SearchResult& found, Fit& fit, const std::function<void(std::string_view)>& progress) {
  constexpr int most_rounds = 2;
  bool any = false;
  std::set<const Hypothesis*> gone;
  std::vector<Active> names = before;
  for (int round = 0; round < most_rounds; ++round) {
    const std::size_t known = gone.size();
    for (const Active& then : names)
      if (!has(fit.model, *then.hypothesis)) gone.insert(then.hypothesis);
    if (gone.size() == known) break;
    auto more = search_on(fitter, bar_for(fitter.nominal()), found, fit, gone, progress);
    if (!more) break;
    found = std::move(*more), fit = found.final, any = true;
    names = fit.model.effects;
    keep_confirmed(forward, fitter, found, fit, progress);
  }
  return any;
}

}  // namespace feedtwin::tools::diagnosis
