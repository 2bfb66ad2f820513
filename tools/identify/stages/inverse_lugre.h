#pragma once
// All friction of an axis as one LuGre contact, from motion and torque command alone: eight parameters of the inverse model.
//
//   F = M a + sigma0 z + sigma1 dz/dt + mu v + F_0,   dz/dt = v - sigma0 |v| z / g(v),   g = F_C + (F_S - F_C) e^(-|v|/v_S)
//
// With the bristle's force in units of F_C, five of the eight (M, F_C, sigma1, mu, F_0) are linear and follow in closed
// form (inverse_projection.h); sigma0 / F_C, F_S / F_C and v_S are searched for on what the projection leaves
// (inverse_search.h). The bristle over a tick is the plant's own step; one pass over the record in lanes gives all that a
// step of the search needs (lanes/inverse_kernel.h).

#include <optional>
#include <span>
#include <vector>

#include "tools/identify/stages/component_forces.h"
#include "tools/identify/stages/inverse_projection.h"

namespace feedtwin::tools {

struct InverseLugreFit {
  double mass_kg = 0.0, coulomb_N = 0.0, static_N = 0.0, stribeck_m_per_s = 0.0, viscous_Ns_per_m = 0.0;
  double stiffness_N_per_m = 0.0, damping_Ns_per_m = 0.0, offset_N = 0.0;
  double cost = 0.0;  ///< sum of squares, N^2
  int passes = 0;     ///< over the record
};

/// Where the three are searched from.
struct InverseLugreStart {
  double bristle_length_m = 2e-6;  ///< F_C / sigma0
  double static_over_coulomb = 1.3, stribeck_m_per_s = 1e-3;
};

/// The force of the torque command over each tick, and the motion in it, made ready once for any number of starts.
class InverseLugre {
 public:
  explicit InverseLugre(std::span<const ComponentForces> runs);
  [[nodiscard]] std::optional<InverseLugreFit> fit(const InverseLugreStart& start = {}) const;
  /// The sum of squares for any eight numbers: what searches without the projection go by.
  [[nodiscard]] double cost(const InverseLugreFit& at) const;

  struct Run {
    double sample_s = 0.0;
    std::vector<double> velocity, acceleration, force_N;  ///< of each tick
  };

 private:
  std::vector<Run> runs_;
  std::size_t samples_ = 0;
  double fastest_m_per_s_ = 0.0;
  Eigen::Matrix4d products_ = Eigen::Matrix4d::Zero();  ///< of the motion's columns
};

}  // namespace feedtwin::tools
