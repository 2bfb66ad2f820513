#pragma once
// How far apart two models of the same axis come in an experiment that nobody has made yet.
//
//   d^2 = Delta^T (Sigma + J C J^T)^-1 Delta
//
// Delta: what the closed loop under the one shows less what it shows under the other, channel by channel; Sigma: the colour
// of what the present model leaves of the recordings; J, C: the other's numbers and how well the recordings know them, so
// that it may bend as far as they let it. The log likelihood ratio of the two is then N(d^2 / 2, d^2) where the one is true.

#include "controllers/cascade.h"
#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/planning/moves.h"
#include "tools/identify/whitening.h"

namespace feedtwin::tools::diagnosis {

/// A model with the covariance of its base parameters (in tolerances) and effects' working parameters, as Fit has it.
struct Contender {
  Candidate model;
  Eigen::MatrixXd covariance;
};

/// Chance that the true one of the two comes out twenty times as likely as the other.
[[nodiscard]] double chance_to_tell(double distance);

class Separation {
 public:
  /// @param forward of the runs of the fit; @param present the model that they are left over from
  Separation(const ForwardModel& forward, const Fitter& fitter, const Candidate& present,
             const std::optional<controllers::CascadeGains>& controller);

  /// d; with `bent` false the other's numbers stay where they are, which is quicker and never less.
  [[nodiscard]] double distance(const Move& move, const Candidate& truth, const Contender& other, bool bent) const;

 private:
  /// Everything that a move shows, each value over its noise's deviation.
  [[nodiscard]] Vector shown(const Move& move, const Candidate& model) const;

  const Fitter* fitter_;
  controllers::CascadeGains gains_;
  double fastest_m_per_s_ = 0.0, sample_s_ = 1e-3;
  /// Of means over `block` samples (power: over its meter's windows); a channel that is not recorded has none.
  std::map<std::string, tools::Whitening, std::less<>> colour_;
};

}  // namespace feedtwin::tools::diagnosis
