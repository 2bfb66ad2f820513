#include "tools/diagnose/wider_stribeck.h"

#include <fmt/format.h>

namespace feedtwin::tools::diagnosis {

std::optional<Fit> with_wider_stribeck(const Fitter& fitter, const Fit& fit, const Whitening& whitening,
                                       const std::function<void(std::string_view)>& progress) {
  constexpr double worth = 30.0;  // of the cost
  std::optional<Fit> best;
  for (const double factor : {4.0, 16.0}) {
    Candidate start = fit.model;
    for (auto* contact : {&start.axis.ball_screw, &start.axis.guide}) {
      contact->stribeck_m_per_s.pos *= factor;
      contact->stribeck_m_per_s.neg *= factor;
    }
    Fit other = fitter.fit(start, whitening, 2 * refit_iterations);
    if (other.cost < fit.cost - worth && (!best || other.cost < best->cost)) best = std::move(other);
  }
  if (best)
    progress(
        fmt::format("a Stribeck velocity of {:.2g} m/s explains more", best->model.axis.ball_screw.stribeck_m_per_s.pos));
  return best;
}

}  // namespace feedtwin::tools::diagnosis
