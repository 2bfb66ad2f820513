#pragma once
// Friction of both contacts followed along recorded motions, a few at once: each lane has a motion and a parameter set of
// its own, so that the runs of a recording, or the parameter sets of a Jacobian, share a pass.

#include <cstddef>

#include "plant/contacts.h"

namespace feedtwin::tools::lanes {

/// One motion with one parameter set. Arrays by sample are `samples` long, those by sub-step `substeps` times as long.
struct FollowedMotion {
  const plant::Contacts<double>* contacts;
  std::size_t samples;
  std::size_t substeps;  ///< a sample; the same in all lanes
  double substep_s;
  const double *path_m_per_s, *table_path_m_per_s;  ///< of motor and table, by sub-step
  const double *screw_sliding, *screw_viscous;      ///< factors by sample, see FrictionScale; nullptr: 1
  const double *guide_sliding, *guide_viscous;
  double *screw_N, *guide_N;  ///< what comes out: means over each sample
};

/// @param motions as many as the kernel has lanes; bristles start unloaded
using FollowKernel = void (*)(const FollowedMotion* motions);

}  // namespace feedtwin::tools::lanes
