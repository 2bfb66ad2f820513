#pragma once
// Which hypotheses the recording asks for: each judged with all numbers floating, exchanged for others and dropped until
// nothing improves; each asked at the end whether it holds on time that it was not fitted to, and what else could have
// taken its place.

#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "tools/diagnose/screen.h"

namespace feedtwin::tools::diagnosis {

/// What a hypothesis must do to be named.
struct Bar {
  double p_false_alarm = 0.005;  ///< over all hypotheses together
  double gain = 20.0;            ///< fall of the cost; an effect of a fraction of the noise over thousands of rows
  double per_parameter = 8.0;    ///< and so much more for each further parameter
  double force_N = 0.5;          ///< where less is left over, strength is counted against this
  double slip_m = 5e-8, power_W = 0.03;
  double absorbed_gain = 25.0;  ///< of what the nominal numbers can nearly do: fall of the cost with their deviations
  double absorbed_strength = 0.15;
  double sure_surprise = 150.0;   ///< the numbers would have to be so far off that it may leave next to nothing over
  double against_nominal = 8.0;   ///< rise of the nominal numbers' squared deviations that makes an absorbed one doubtful
  double strength_against = 0.6;  ///< least strength then
  /// Least strength beside another effect, of that one's in the same equation: models of effects are not perfect.
  double beside = 0.05;
  /// Nor where it leaves so little of what it explains, on every unseen fold: what an imperfect model of the other leaves is
  /// not gone with it. A lead's wave of 0.5 um, beside lost counts, had 7 in the scale's slip.
  double by_itself = 3.0;
  std::size_t folds = 8;  ///< stretches of a second, dealt out in turn
  std::size_t folds_that_gain = 3;
  std::size_t most_effects = 8;
};

/// On an axis of this size.
[[nodiscard]] Bar bar_for(const plant::AxisParameters& nominal);

/// `Found::error_ratio` of a name that explains most of a channel.
inline constexpr double explains_most_ratio = 5.0;

struct Found {
  Active effect;
  double gain = 0.0;      ///< fall of the cost that it brings, everything else refitted
  double share = 0.0;     ///< of the cost without it
  double strength = 0.0;  ///< what is left over without it beyond what is left over with it, as a ratio of rms
  double p_false_alarm = 1.0;
  std::vector<const Hypothesis*> rivals;  ///< fit as well in its place
  bool held_everywhere = false;           ///< on every unseen fold, with nearly all of its gain
  bool far_off = false;                   ///< the numbers could do it, far from nominal: no channel bears it out
  bool by_closed_loop = false;            ///< asked for by the closed loop alone
  bool by_runs_alone = false;             ///< and there no channel says so
  bool by_common_shift = false;           ///< numbers could do it, all off by the same share
  double error_ratio = 1.0;               ///< how many times as far off the closed loop is without it, its numbers refitted
  double missed_nats = 0.0;  ///< how much less likely the runs are in closed loop without it, all other numbers free
};

struct SearchResult {
  Fit recalibrated;  ///< without any effect
  Fit final;
  Whitening whitening;  ///< of the final fit
  std::vector<Found> found;
  Screen last;  ///< what the final model leaves over

  /// What was found of it; nullptr where it is not named.
  [[nodiscard]] Found* of(const Hypothesis* hypothesis);
};

/// @param progress called with what is being done
[[nodiscard]] SearchResult search(const Fitter& fitter, const Bar& bar,
                                  const std::function<void(std::string_view)>& progress);

/// Once more, where the other engine has taken names away: what they hid is asked for beside those that are left.
/// @param now the best model without them
/// @param not_these that were taken away
/// @return nothing, where no name came
[[nodiscard]] std::optional<SearchResult> search_on(const Fitter& fitter, const Bar& bar, const SearchResult& before,
                                                    const Fit& now, const std::set<const Hypothesis*>& not_these,
                                                    const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
