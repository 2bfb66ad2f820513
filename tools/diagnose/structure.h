#pragma once
// Is what a model leaves over still structure? A general additive model of the force remainder - tables over place, speed,
// time since reversal or since a rest, acceleration, speed-weighted place, the acceleration's past, springs that give way
// with time, what fades with use, speed by region of the travel - what keeps time and a part that rings, learned on three
// quarters of the seconds and judged on the fourth, in turn.

#include <optional>
#include <vector>

#include "tools/diagnose/additive_model.h"
#include "tools/diagnose/beat.h"
#include "tools/diagnose/folded.h"
#include "tools/diagnose/inverse_model.h"
#include "tools/diagnose/moments.h"
#include "tools/diagnose/ringing.h"

namespace feedtwin::tools::diagnosis {

inline constexpr double least_share_of_much = 0.14;

struct Structure {
  double remainder_N = 0.0;   ///< rms of the remainder where the axis has settled, less what the numbers could still take up
  double share = 0.0;         ///< of its square that the additive model predicts on seconds it has not seen; may be negative
  double gives_way = 0.0;     ///< of that share what only springs that give way with time predict
  std::optional<Mode> rings;  ///< where a part that rings is most of it
  double newton = 1.0;        ///< what stands for one on this axis (size_of_axis.h)
  [[nodiscard]] double structured_N() const;
  /// So much is `unknown` beside names too, where they leave it.
  [[nodiscard]] bool much() const;
  /// So much is `unknown`. @param nothing_named that rests on a force: all of it is unexplained then
  [[nodiscard]] bool is_unknown(bool nothing_named) const;
};

class RepeatableStructure {
 public:
  /// @param model must outlive this
  explicit RepeatableStructure(const InverseModel& model);

  /// Of the sum of all force equations.
  [[nodiscard]] Structure remaining(const Vector& residual) const;
  /// Of the table's own equation, behind a force sensor: what acts on the table shows there without the noise of motor and
  /// screw. None where no force was recorded.
  [[nodiscard]] Structure of_the_table(const Vector& residual) const;
  /// What the additive model, or those of its parts that do best, predict of each force equation's residual on seconds
  /// that they have not seen; zero where they have nothing to say. What is left without it is nearer to noise.
  [[nodiscard]] Vector part_of(const Vector& residual) const;

 private:
  /// By the best of the first so many ways.
  [[nodiscard]] Vector unseen(const AdditiveModel& additive, const Vector& y, std::size_t ways) const;
  [[nodiscard]] AdditiveModel additive_over(const std::vector<Moment>& moments) const;
  [[nodiscard]] Structure within(Vector forces_N) const;
  [[nodiscard]] Vector gathered(const Vector& residual, std::size_t equation) const;

  const InverseModel& model_;
  std::vector<std::vector<Index>> places_;  ///< settled rows of every run
  std::vector<Moment> moments_;
  Eigen::MatrixXd numbers_;  ///< a row a settled row: what mass and friction could do
  AdditiveModel additive_;
  std::optional<Beat> beat_;
  std::optional<Folded> folded_;
  std::optional<Ringing> ringing_;
};

}  // namespace feedtwin::tools::diagnosis
