#pragma once
// What the closed loop makes of an explanation: its numbers as polished there, and how likely the runs are under it. Numbers
// that would do for two explanations must not decide between them, so each also starts from the other's.

#include <limits>
#include <memory>
#include <optional>

#include "tools/diagnose/forward/likelihood.h"
#include "tools/diagnose/forward/polish.h"
#include "tools/diagnose/forward/slopes.h"
#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

/// What decides between two explanations. Of some thirty decisions on eight sets four were wrong: with 84 nats and 0.9
/// deviations, 112 and 1.7, 6789 and 2.1, 253 and 3.9; of the right ones all but two had 102 and 2.6 at least.
inline constexpr double clearly_nats = 100.0, clearly_deviations = 2.4;
/// What a polish must bring to go on with it.
inline constexpr double of_consequence_nats = 10.0;

/// Slopes and the effects of the model that they were seen with.
struct SeenSlopes {
  std::shared_ptr<const Slopes> slopes;  ///< none yet: nullptr
  std::vector<const Hypothesis*> effects;

  bool operator==(const SeenSlopes&) const = default;
};

struct Ruling {
  Fit fit;          ///< by the inverse model
  Candidate model;  ///< polished in closed loop
  Likelihood likelihood;
  double value = 0.0;  ///< nats, less what its parameters cost
  SeenSlopes seen;     ///< by the first explanation's polish
  /// Its model was polished further, with slopes of its own, and the runs became no likelier: once more would be the same.
  bool exhausted = false;
};

/// Of an explanation that is compared with none.
inline constexpr double none_ahead = -std::numeric_limits<double>::infinity();

/// @param ahead value of the explanation that it is compared with: one that is hopelessly behind is polished no further
[[nodiscard]] Ruling rule(const Fit& fit, const ForwardModel& forward, const Fitter& fitter, double ahead = none_ahead);
/// Not polished.
[[nodiscard]] Ruling rule_as_it_is(const Fit& fit, const ForwardModel& forward, const Fitter& fitter);
/// Slopes of the nominal model's numbers for a polish: those of the ruling before it cost nothing, and serve where the
/// numbers stay about where they were.
enum class SlopesOf { before, anew };
/// The same model, polished further.
[[nodiscard]] Ruling rule_again(const Ruling& before, const ForwardModel& forward, const Fitter& fitter, SlopesOf slopes);
/// Another explanation, from its own numbers or from those of one that was polished before, whichever are likelier.
[[nodiscard]] Ruling rule_beside(const Ruling& before, const Fit& fit, const ForwardModel& forward, const Fitter& fitter,
                                 SlopesOf slopes, double ahead = none_ahead);
/// One effect more than before, its last, from the numbers before and along all slopes that were seen then: what it may
/// bring.
/// @param least_promise_nats where straight slopes promise less of it, no step is simulated
[[nodiscard]] Ruling glance_at_one_more(const Ruling& before, const Fit& fit, const ForwardModel& forward,
                                        const Fitter& fitter, double least_promise_nats);
/// One effect more than before. Where that goes astray, since without any of it the runs are likelier, from none.
/// @param more its place among the fit's effects
[[nodiscard]] Ruling rule_with_one_more(const Ruling& before, Fit fit, std::size_t more, const ForwardModel& forward,
                                        const Fitter& fitter);
/// The last word on its numbers: the first steps go along the slopes that were seen, all others along slopes of their own.
/// @param otherwise the model where the closed loop was not asked: nothing was seen of it
[[nodiscard]] Polished polish_settled(const std::optional<Ruling>& settled, const Candidate& otherwise,
                                      const ForwardModel& forward, const Fitter& fitter);
/// The one that is behind is polished further, from its own numbers or the other's, as long as that helps and it is not
/// hopelessly behind: what decides must not be who was polished more.
void contest(Ruling& one, Ruling& other, const ForwardModel& forward, const Fitter& fitter);

/// Is it a finding, of a size that is possible on this axis?
[[nodiscard]] bool can_be_named(const Active& active, const plant::AxisParameters& axis);

}  // namespace feedtwin::tools::diagnosis
