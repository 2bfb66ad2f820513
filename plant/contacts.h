#pragma once
// The axis's two LuGre contacts, ball screw and linear guide, evaluated together over a sub-step. For one axis the
// two fill the two lanes of one register; for several axes at a time each contact has registers of its own.

#include "plant/lugre.h"

namespace feedtwin::plant {

/// One contact with both directions of motion.
template <class Real>
struct Contact {
  LugreSide<Real> pos, neg;
  LugreBristle<Real> bristle;
};

/// How effects (heat, position, load) change friction in a sub-step; all one without them.
template <class Real>
struct FrictionScale {
  Real screw_sliding = Real{} + 1.0;  ///< on F_C and F_S of the ball screw
  Real screw_viscous = Real{} + 1.0;
  Real guide_sliding = Real{} + 1.0;
  Real guide_viscous = Real{} + 1.0;
};

/// Both contacts over a sub-step at the predicted speed; slopes are by the velocity.
template <class Real>
struct ContactsStep {
  Real screw_force_N{}, guide_force_N{};
  Real screw_force_slope_Ns_per_m{}, guide_force_slope_Ns_per_m{};
  Real screw_bristle_m{}, guide_bristle_m{};
  Real screw_bristle_slope_s{}, guide_bristle_slope_s{};
  Real screw_bristle_limit_m{}, guide_bristle_limit_m{};
  Real screw_viscous_Ns_per_m{}, guide_viscous_Ns_per_m{};  ///< unscaled, in the direction of motion
};

/// Both contacts at an instant.
template <class Real>
struct ContactForces {
  Real screw_N{}, guide_N{};
};

/// How the axis moves in a sub-step.
template <class Real>
struct Sliding {
  Real sign{};           ///< direction of motion, +1 or -1
  Real speed_m_per_s{};  ///< predicted mean speed, >= 0
  Real h_s{};
  Real per_h_Hz{};  ///< 1 / h
};

/// Scaled coefficients of the direction that is in force.
template <class Real, class Mask>
[[nodiscard]] inline LugreSide<Real> side_in_force(const Contact<Real>& contact, const Mask& positive, Real sliding,
                                                   Real viscous) noexcept {
  return {(positive ? contact.pos.coulomb_N : contact.neg.coulomb_N) * sliding,
          (positive ? contact.pos.stribeck_rise_N : contact.neg.stribeck_rise_N) * sliding,
          positive ? contact.pos.inverse_stribeck_s_per_m : contact.neg.inverse_stribeck_s_per_m,
          (positive ? contact.pos.viscous_Ns_per_m : contact.neg.viscous_Ns_per_m) * viscous};
}

/// Ball screw and guide of one or more axes.
template <class Real>
struct Contacts {
  Contact<Real> screw, guide;

  [[nodiscard]] Real stiffness_force_N(Real screw_bristle_m, Real guide_bristle_m) const noexcept {
    return screw.bristle.stiffness_N_per_m * screw_bristle_m + guide.bristle.stiffness_N_per_m * guide_bristle_m;
  }

  /// What they resist with, in the direction of motion.
  [[nodiscard]] ContactForces<Real> now(Real velocity_m_per_s, Real screw_bristle_m, Real guide_bristle_m,
                                        const FrictionScale<Real>& scale) const noexcept {
    const auto positive = velocity_m_per_s > 0.0;
    return {lugre_force_N<Real>(screw.bristle, side_in_force(screw, positive, scale.screw_sliding, scale.screw_viscous),
                                velocity_m_per_s, screw_bristle_m),
            lugre_force_N<Real>(guide.bristle, side_in_force(guide, positive, scale.guide_sliding, scale.guide_viscous),
                                velocity_m_per_s, guide_bristle_m)};
  }

  [[nodiscard]] ContactsStep<Real> step(const Sliding<Real>& m, Real screw_bristle_m, Real guide_bristle_m,
                                        const FrictionScale<Real>& scale) const noexcept {
    const auto positive = m.sign > 0.0;
    const auto s = lugre_step<Real>(screw.bristle, side_in_force(screw, positive, scale.screw_sliding, scale.screw_viscous),
                                    m.sign, m.speed_m_per_s, screw_bristle_m, m.h_s, m.per_h_Hz);
    const auto g = lugre_step<Real>(guide.bristle, side_in_force(guide, positive, scale.guide_sliding, scale.guide_viscous),
                                    m.sign, m.speed_m_per_s, guide_bristle_m, m.h_s, m.per_h_Hz);
    return {s.force_N,
            g.force_N,
            s.force_slope_Ns_per_m,
            g.force_slope_Ns_per_m,
            s.bristle_m,
            g.bristle_m,
            s.bristle_slope_s,
            g.bristle_slope_s,
            s.bristle_limit_m,
            g.bristle_limit_m,
            positive ? screw.pos.viscous_Ns_per_m : screw.neg.viscous_Ns_per_m,
            positive ? guide.pos.viscous_Ns_per_m : guide.neg.viscous_Ns_per_m};
  }
};

/// One axis: lane 0 the ball screw, lane 1 the guide.
template <>
struct Contacts<double> {
  using Pair = Doubles<2>;
  Contact<Pair> both;

  [[nodiscard]] double stiffness_force_N(double screw_bristle_m, double guide_bristle_m) const noexcept {
    return both.bristle.stiffness_N_per_m[0] * screw_bristle_m + both.bristle.stiffness_N_per_m[1] * guide_bristle_m;
  }

  [[nodiscard]] LugreSide<Pair> side_in_force(bool positive, const FrictionScale<double>& scale) const noexcept {
    LugreSide<Pair> side = positive ? both.pos : both.neg;
    const Pair sliding = {scale.screw_sliding, scale.guide_sliding};
    side.coulomb_N *= sliding;
    side.stribeck_rise_N *= sliding;
    side.viscous_Ns_per_m *= Pair{scale.screw_viscous, scale.guide_viscous};
    return side;
  }

  [[nodiscard]] ContactForces<double> now(double velocity_m_per_s, double screw_bristle_m, double guide_bristle_m,
                                          const FrictionScale<double>& scale) const noexcept {
    const auto force_N = lugre_force_N<Pair>(both.bristle, side_in_force(velocity_m_per_s > 0.0, scale),
                                             Pair{} + velocity_m_per_s, Pair{screw_bristle_m, guide_bristle_m});
    return {force_N[0], force_N[1]};
  }

  [[nodiscard]] ContactsStep<double> step(const Sliding<double>& m, double screw_bristle_m, double guide_bristle_m,
                                          const FrictionScale<double>& scale) const noexcept {
    const bool positive = m.sign > 0.0;
    const Pair viscous = (positive ? both.pos : both.neg).viscous_Ns_per_m;
    const LugreSide<Pair> side = side_in_force(positive, scale);
    const auto p = lugre_step<Pair>(both.bristle, side, Pair{} + m.sign, Pair{} + m.speed_m_per_s,
                                    Pair{screw_bristle_m, guide_bristle_m}, Pair{} + m.h_s, Pair{} + m.per_h_Hz);
    return {p.force_N[0],
            p.force_N[1],
            p.force_slope_Ns_per_m[0],
            p.force_slope_Ns_per_m[1],
            p.bristle_m[0],
            p.bristle_m[1],
            p.bristle_slope_s[0],
            p.bristle_slope_s[1],
            p.bristle_limit_m[0],
            p.bristle_limit_m[1],
            viscous[0],
            viscous[1]};
  }
};

}  // namespace feedtwin::plant
