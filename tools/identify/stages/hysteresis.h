#pragma once
// Stage (d): bristle stiffness and damping of one contact from its hysteresis, with the sliding friction of stage (c) given.
//
//   F - m a - mu v = sigma0 z + sigma1 dz/dt,   dz/dt = v - sigma0 |v| z / g(v)             Eq. 2
//
// The bristle follows from the recorded motion and sigma0 alone (plant/lugre.h: closed form over a tick), so sigma1 is
// linear and only sigma0 is searched for.

#include <optional>
#include <span>
#include <vector>

#include "plant/parameters.h"
#include "tools/identify/stages/component_forces.h"

namespace feedtwin::tools {

struct HysteresisFit {
  double stiffness_N_per_m = 0.0, damping_Ns_per_m = 0.0;
  double rms_N = 0.0;  ///< of what is left
  std::size_t samples = 0;
};

/// @param friction sliding numbers of the contact; its stiffness is where the search is centred (a factor of 30 either way)
/// @param mass_kg what the component's force accelerates
/// Nothing where fewer than 20 samples lie within a few bristle lengths of a reversal.
[[nodiscard]] std::optional<HysteresisFit> fit_hysteresis(std::span<const ComponentForces> runs,
                                                          std::vector<double> ComponentForces::* component, double mass_kg,
                                                          const plant::LugreParameters& friction);

/// The same squares for any stiffness and damping: for searches that know nothing of the projection.
class HysteresisCost {
 public:
  HysteresisCost(std::span<const ComponentForces> runs, std::vector<double> ComponentForces::* component, double mass_kg,
                 const plant::LugreParameters& friction);
  ~HysteresisCost();
  HysteresisCost(const HysteresisCost&) = delete;
  HysteresisCost& operator=(const HysteresisCost&) = delete;
  [[nodiscard]] double rms_N(double stiffness_N_per_m, double damping_Ns_per_m) const;
  /// The best damping for this stiffness.
  [[nodiscard]] HysteresisFit projected(double stiffness_N_per_m) const;
  [[nodiscard]] std::size_t samples() const;

  /// The component's force for the recorded motion, row by row; bristles start relaxed.
  [[nodiscard]] static std::vector<double> model_N(const ComponentForces& run, double mass_kg,
                                                   const plant::LugreParameters& friction);

 private:
  struct Run;
  std::vector<Run> runs_;
};

}  // namespace feedtwin::tools
