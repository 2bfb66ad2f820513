#pragma once
// The follow kernel's body; as in kernel_body.h, each instruction set has a lane type of its own.

#include "plant/axis_lanes.h"
#include "tools/identify/lanes/follow_kernel.h"

namespace feedtwin::tools::lanes {

/// What each lane has at an index of its own array; `none` where the motion has ended or the array is not there.
template <class Real, class Member>
[[gnu::always_inline]] inline Real gathered(const FollowedMotion* motions, Member array, std::size_t sample,
                                            std::size_t index, double none) noexcept {
  Real all{};
  for (std::size_t lane = 0; lane < sizeof(Real) / sizeof(double); ++lane) {
    const double* from = motions[lane].*array;
    all[lane] = from != nullptr && sample < motions[lane].samples ? from[index] : none;
  }
  return all;
}

/// One contact's bristle along a sub-step of constant velocity. @return its mean force
template <class Real>
[[gnu::always_inline]] inline Real follow_contact(const plant::Contact<Real>& contact, Real v, Real sliding, Real viscous,
                                                  Real h_s, Real per_h_Hz, Real& bristle_m) noexcept {
  const Real sign = v < 0.0 ? Real{} - 1.0 : Real{} + 1.0;
  const auto step = plant::lugre_step<Real>(contact.bristle, plant::side_in_force(contact, sign > 0.0, sliding, viscous),
                                            sign, plant::absolute<Real>(v), bristle_m, h_s, per_h_Hz);
  bristle_m = step.bristle_m;
  return step.force_N;
}

template <class Real>
void run_follow(const FollowedMotion* motions) {
  constexpr std::size_t width = sizeof(Real) / sizeof(double);
  plant::Contacts<Real> contacts;
  Real h_s{};
  std::size_t samples = 0;
  bool screw_scaled = false, guide_scaled = false;
  for (std::size_t lane = 0; lane < width; ++lane) {
    const auto& motion = motions[lane];
    plant::detail::set_contact(contacts.screw, lane, motion.contacts->both, 0);
    plant::detail::set_contact(contacts.guide, lane, motion.contacts->both, 1);
    h_s[lane] = motion.substep_s;
    samples = motion.samples > samples ? motion.samples : samples;
    screw_scaled = screw_scaled || motion.screw_sliding != nullptr || motion.screw_viscous != nullptr;
    guide_scaled = guide_scaled || motion.guide_sliding != nullptr || motion.guide_viscous != nullptr;
  }
  const std::size_t substeps = motions[0].substeps;
  const double share = 1.0 / static_cast<double>(substeps);
  const Real per_h_Hz = 1.0 / h_s;
  Real screw_m{}, guide_m{};
  for (std::size_t k = 0; k < samples; ++k) {
    plant::FrictionScale<Real> scale;
    if (screw_scaled) {
      scale.screw_sliding = gathered<Real>(motions, &FollowedMotion::screw_sliding, k, k, 1.0);
      scale.screw_viscous = gathered<Real>(motions, &FollowedMotion::screw_viscous, k, k, 1.0);
    }
    if (guide_scaled) {
      scale.guide_sliding = gathered<Real>(motions, &FollowedMotion::guide_sliding, k, k, 1.0);
      scale.guide_viscous = gathered<Real>(motions, &FollowedMotion::guide_viscous, k, k, 1.0);
    }
    Real screw_N{}, guide_N{};
    for (std::size_t i = k * substeps; i < (k + 1) * substeps; ++i) {
      const Real v = gathered<Real>(motions, &FollowedMotion::path_m_per_s, k, i, 0.0);
      const Real table_v = gathered<Real>(motions, &FollowedMotion::table_path_m_per_s, k, i, 0.0);
      screw_N += follow_contact<Real>(contacts.screw, v, scale.screw_sliding, scale.screw_viscous, h_s, per_h_Hz, screw_m);
      guide_N +=
          follow_contact<Real>(contacts.guide, table_v, scale.guide_sliding, scale.guide_viscous, h_s, per_h_Hz, guide_m);
    }
    for (std::size_t lane = 0; lane < width; ++lane) {
      if (k >= motions[lane].samples) continue;
      motions[lane].screw_N[k] = screw_N[lane] * share;
      motions[lane].guide_N[k] = guide_N[lane] * share;
    }
  }
}

}  // namespace feedtwin::tools::lanes
