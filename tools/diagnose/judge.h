#pragma once
// What a hypothesis is worth: how strong it is in the units of the channels, and whether it holds on time that it was
// not fitted to.

#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

/// How much the fits differ, rms, over the rms of what the better one leaves over, for each equation. Force equations count
/// where the axis has settled, and about reversals too where these are asked for.
/// @param only these rows; empty: all
[[nodiscard]] std::vector<double> strengths(const InverseModel& model, const Fit& with, const Fit& without,
                                            bool about_reversals, const Bar& bar, const std::vector<bool>& only = {});

/// The rows where an effect acts: by a tenth of its most in that equation, or more.
[[nodiscard]] std::vector<bool> rows_of(const InverseModel& model, const Fit& with, const Fit& without);

/// The largest of them.
[[nodiscard]] double strength(const InverseModel& model, const Fit& with, const Fit& without, bool about_reversals,
                              const Bar& bar);

/// Is what an effect does, against a fit that does without it, enough to name it?
struct Verdict {
  double gain = 0.0, surprise = 0.0, strength = 0.0;
  bool enough = false;
  bool far_off = false;  ///< the numbers could do it, far from nominal
};

[[nodiscard]] Verdict judged(const Fitter& fitter, const Fit& with, const Fit& without, const Hypothesis& hypothesis,
                             const Bar& bar);

/// Fall of the cost of each fold that the other folds' estimate of everything brings, with the effect against without.
/// Both fits under the same whitening.
[[nodiscard]] std::vector<double> gains_by_fold(const InverseModel& model, const Fit& with, const Fit& without,
                                                std::size_t folds);

/// What an effect is worth on stretches that it was not fitted to, and whether that is enough.
struct Unseen {
  double gain = 0.0;
  std::size_t folds = 0;  ///< that gain
  bool everywhere = false, holds = false;
};

[[nodiscard]] Unseen on_unseen(const InverseModel& model, const Fit& with, const Fit& without, const Hypothesis& hypothesis,
                               const Verdict& verdict, const Bar& bar);

/// Strength that an effect has, of the strongest other one's where it acts: what that one's model leaves over is there too.
/// In the equation where that is most, of those that it shows in. The other counts by what it does itself: without clipping
/// of power that is given back the numbers bend and move the forces too, which it never acts on.
/// @param less fits without each effect
[[nodiscard]] double share_beside(const InverseModel& model, const Fit& fit, const std::vector<Fit>& less,
                                  std::size_t effect, const Bar& bar);

/// May it be what an imperfect model of a stronger effect leaves over?
/// @param share that it has of the strongest other one
[[nodiscard]] bool hidden_beside(double share, const Verdict& verdict, const Unseen& unseen, const Bar& bar);

/// Covariance of the unknowns, widened to what a delete-a-group jackknife over seconds finds: the laws are not exact and
/// the noise is not of one colour, so that rows say less than they seem to.
[[nodiscard]] Eigen::MatrixXd robust_covariance(const InverseModel& model, const Fit& fit);
/// And by what is left over beyond one a row.
[[nodiscard]] Eigen::MatrixXd covariance_by_what_is_left(const InverseModel& model, const Fit& fit);

}  // namespace feedtwin::tools::diagnosis
