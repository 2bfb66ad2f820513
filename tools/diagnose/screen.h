#pragma once
// Every hypothesis against what the present model leaves over: how much of it each would explain with the model's numbers
// floating, and how much the best of all would explain by chance on surrogates of that residual.

#include <string>
#include <vector>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

struct Score {
  const Hypothesis* hypothesis = nullptr;
  std::vector<double> q;  ///< best shape with its linear amplitudes
  double touched = 0.0;   ///< cost in the equations that it has a part in
  double gain = 0.0;      ///< fall of the cost
  double standard = 0.0;  ///< gain less its mean on surrogates, in their standard deviations
  /// The same by other whole numbers, nearly as much: rows four samples apart show one order as another.
  std::vector<std::vector<double>> also = {};
};

struct Screen {
  std::vector<Score> scores;   ///< best first, one a hypothesis
  std::vector<double> chance;  ///< the largest standard score of each surrogate, sorted
  /// Chance that the best of all hypotheses scores this on the record's own residual with no effect in it.
  [[nodiscard]] double p_false_alarm(double standard) const;
  /// Is nearly as much left to a hypothesis as it had before the model got its names? Then none of these stands for it: they
  /// are about another thing.
  [[nodiscard]] bool leaves_to(const Score& before) const;
};

/// "cogging would explain 81.2 % (gain 9013, p 1e-09), ...": the best of them, for whoever waits.
[[nodiscard]] std::string in_words(const Screen& screened);
/// The hypothesis with its best shape and no strength yet: where a joint fit starts from.
[[nodiscard]] Active at_zero(const Score& score);
/// A model with this effect more, refitted from zero and from wherever else the effect has a start. It stands at `place`.
[[nodiscard]] Fit fit_with(const Fitter& fitter, const Candidate& model, const Score& more, std::size_t place,
                           const Whitening& whitening, int iterations);

[[nodiscard]] Screen screen(const Fitter& fitter, const Fit& fit, const Whitening& whitening);
/// Some hypotheses alone, without asking what chance does.
[[nodiscard]] std::vector<Score> scores_of(const std::vector<const Hypothesis*>& only, const Fitter& fitter, const Fit& fit,
                                           const Whitening& whitening);

}  // namespace feedtwin::tools::diagnosis
