#pragma once
// The second engine's judgement between explanations that are easily confused: each is fitted anew and simulated in closed
// loop, and the likelihoods of what is left over are compared. Takes a better one in a named one's place; where none is
// clearly better both stay in question; one that is clearly worse is ruled out.

#include <optional>

#include "tools/diagnose/forward/ruling.h"
#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

/// What comes of a named effect and a rival in its place.
enum class Between { named_stays, rival_takes_the_place, both_in_question };
/// @param better_nats how much likelier the rival is  @param clear beyond doubt, one way or the other
/// Of two of which one is a case of the other (Hypothesis::special_case) the simpler is told where it is as likely.
[[nodiscard]] Between between(const Hypothesis& named, const Hypothesis& rival, double better_nats, bool clear);

class Arbiter {
 public:
  Arbiter(const ForwardModel& forward, const Fitter& fitter, const std::function<void(std::string_view)>& progress)
      : forward_(forward), fitter_(fitter), progress_(progress) {}

  /// Settles every named effect of the fit; what it changes is changed in both.
  /// @param before the fit's model as the closed loop has it, where it was asked already
  /// @return likewise; where nothing is named, what it was given
  std::optional<Ruling> settle(SearchResult& found, Fit& fit, std::optional<Ruling> before = {}) const;

 private:
  /// @param beaten were exchanged before and are not asked again
  [[nodiscard]] bool exchanged(SearchResult& found, Fit& fit, Ruling& now, std::size_t effect,
                               std::vector<const Hypothesis*>& beaten) const;

  const ForwardModel& forward_;
  const Fitter& fitter_;
  const std::function<void(std::string_view)>& progress_;
};

}  // namespace feedtwin::tools::diagnosis
