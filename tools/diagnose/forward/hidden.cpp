#include "tools/diagnose/forward/hidden.h"

#include <algorithm>
#include <set>

#include "tools/diagnose/forward/confirm.h"

namespace feedtwin::tools::diagnosis {

bool name_what_they_hid(const std::vector<Active>& before, const ForwardModel& forward, const Fitter& fitter,
                        SearchResult& found, Fit& fit, const std::function<void(std::string_view)>& progress) {
  std::set<const Hypothesis*> gone;
  for (const Active& then : before)
    if (!has(fit.model, *then.hypothesis)) gone.insert(then.hypothesis);
  if (gone.empty()) return false;
  auto more = search_on(fitter, bar_for(fitter.nominal()), found, fit, gone, progress);
  if (!more) return false;
  Fit with = more->final;
  keep_confirmed(forward, fitter, *more, with, progress);
  const auto is_new = [&](const Active& now) {
    return !has(fit.model, *now.hypothesis) && worth_naming(now, with.model.axis);
  };
  if (std::ranges::none_of(with.model.effects, is_new)) return false;
  found = std::move(*more), fit = std::move(with);
  return true;
}

}  // namespace feedtwin::tools::diagnosis
