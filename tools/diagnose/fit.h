#pragma once
// All numbers at once: the nominal ones within their tolerance and the effects' own, by Gauss-Newton on the whitened
// residual. The prior on the nominal numbers also settles what the recording can't separate.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "tools/diagnose/base_parameters.h"
#include "tools/diagnose/power_structure.h"
#include "tools/diagnose/structure.h"
#include "tools/diagnose/whitening.h"

namespace feedtwin::tools::diagnosis {

struct Candidate {
  plant::AxisParameters axis;
  std::vector<Active> effects;

  bool operator==(const Candidate&) const = default;
};

[[nodiscard]] Candidate without(const Candidate& model, std::size_t effect);
[[nodiscard]] bool has(const Candidate& model, const Hypothesis& hypothesis);
/// Is none of its effects one that is worth a name and rests on a force?
[[nodiscard]] bool names_no_force(const Candidate& model);

struct Fit {
  Candidate model;
  Vector residual;              ///< in the equations' units
  Vector white;                 ///< whitened residual, then the priors': of the nominal numbers, of effects that have one
  Eigen::MatrixXd jacobian;     ///< of `white` by the unknowns, negative: white ~ white0 - jacobian * change
  Eigen::MatrixXd information;  ///< jacobian' jacobian
  Eigen::MatrixXd covariance;   ///< of the unknowns
  double cost = 0.0;            ///< |white|^2

  [[nodiscard]] Index base_count() const { return static_cast<Index>(base.size()); }
  std::vector<BaseParameter> base;
};

/// Of a refit from numbers that are near already.
inline constexpr int refit_iterations = 6;

class Fitter {
 public:
  Fitter(const InverseModel& model, const plant::AxisParameters& nominal);

  /// From a start, with a given colour. Deterministic. @param iterations five times as many while the cost still falls fast
  [[nodiscard]] Fit fit(const Candidate& start, const Whitening& whitening, int iterations) const;
  /// Residual and derivatives where it stands.
  [[nodiscard]] Fit linearised(const Candidate& at, const Whitening& whitening) const;
  /// A colour first: fits with the residual's own colour of each round.
  [[nodiscard]] Fit fit_with_colour(const Candidate& start, Whitening& whitening, int rounds, int iterations) const;

  /// The noise's colour: of a residual without what repeats in it, which must not be whitened away.
  [[nodiscard]] Whitening colour_of(const Vector& residual) const;

  [[nodiscard]] const InverseModel& model() const { return model_; }
  [[nodiscard]] const RepeatableStructure& structure() const { return structure_; }
  [[nodiscard]] const plant::AxisParameters& nominal() const { return nominal_; }
  [[nodiscard]] const std::vector<BaseParameter>& base() const { return base_; }
  /// From here on the axis has these effects of its own; its nominal numbers stay.
  void take_effects(std::vector<plant::EffectSetting> effects) { nominal_.effects = std::move(effects); }
  /// (value - nominal) in tolerances.
  [[nodiscard]] Vector deviations(const plant::AxisParameters& axis) const;
  /// The sum of their squares, in tolerances: how far an axis is from the file.
  [[nodiscard]] double squared_tolerances(const plant::AxisParameters& axis) const { return deviations(axis).squaredNorm(); }
  /// What one tolerance is, in the parameter's unit.
  [[nodiscard]] double tolerance(std::size_t parameter) const;

 private:
  /// How far the nominal numbers, and effects that have a prior, are from where they are thought to be.
  [[nodiscard]] Vector from_prior(const Candidate& at) const;
  [[nodiscard]] Vector whitened(const Candidate& at, const Vector& residual, const Whitening& whitening) const;
  /// The model with one unknown a small step away, for differences.
  struct Beside {
    Candidate model;
    double step = 0.0;      ///< base: in tolerances; 0: bounds leave no room
    bool refollow = false;  ///< friction is another one
  };
  [[nodiscard]] std::vector<Beside> beside_of(const Candidate& at) const;
  /// Unknowns whose slopes promise what no step keeps: of laws that jump, and numbers of which the rows say nothing where
  /// they stand, as of static friction below Coulomb's: the prior alone would take them to where they say a lot.
  [[nodiscard]] std::vector<Index> without_true_slope(const Fit& fit) const;
  [[nodiscard]] Candidate moved(const Candidate& from, const Vector& step) const;

  const InverseModel& model_;
  plant::AxisParameters nominal_;
  std::vector<BaseParameter> base_;
  RepeatableStructure structure_;
  PowerStructure power_structure_;
};

}  // namespace feedtwin::tools::diagnosis
