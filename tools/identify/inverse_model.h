#pragma once
// Inverse model: the force that the recorded motion asks for, against the force that was commanded.
//
// Derivatives of the recorded position come from a zero-phase low-pass and central differences; both sides then go through
// the same decimation (Janot, Gautier, Brunot: EMPS, 2019), so that neither the encoder's grid nor the filter's edge weighs
// in.

#include <vector>

#include "plant/parameters.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools {

struct InverseModelSettings {
  double cutoff_Hz = 100.0;  ///< of the order-4 Butterworth that the position goes through
  double band_Hz = 40.0;     ///< that is kept by the decimation
  bool held_command =
      true;  ///< the force at an instant is the mean of the commands before and after it; false: the later one
  std::size_t lead_in_samples = 49;  ///< left out at the start of the record
};

/// Motion that a recording shows, at its own rate, without the lead-in.
struct RecordedMotion {
  std::vector<double> position_m, velocity_m_per_s, acceleration_m_per_s2, force_N;
  int decimation = 1;
};
[[nodiscard]] RecordedMotion recorded_motion(const Recording& recording, double lead_m,
                                             const InverseModelSettings& settings = {});

/// M a + F_v v + F_c sign(v) + offset = force, by linear least squares.
struct RigidFit {
  double mass_kg = 0.0, viscous_pos_Ns_per_m = 0.0, viscous_neg_Ns_per_m = 0.0, coulomb_N = 0.0, offset_N = 0.0;
  double deviation[5] = {};              ///< of these five, from the residual's variance
  double relative_error = 0.0;           ///< |force - model| / |force|
  std::vector<double> force_N, model_N;  ///< after decimation
};
/// @param directional viscous friction by direction of motion; otherwise one for both
[[nodiscard]] RigidFit fit_rigid_model(const RecordedMotion& motion, bool directional);

/// The force that an axis of the paper's model needs for the motion, bristles included; at the motion's rate.
[[nodiscard]] std::vector<double> inverse_force_N(const plant::AxisParameters& axis, const RecordedMotion& motion,
                                                  double sample_s);

}  // namespace feedtwin::tools
