#pragma once
// One sub-step of Eq. 1, for one axis or several at a time.
//
// Over a sub-step h the mean velocity w = v + theta (v' - v) obeys   M (v' - v) / h = drive - s F_M - B w - F_B(w) - F_L(w)
// - ... which is solved by one Newton step from the predicted mean velocity v + a h / 2; then x' = x + h w. theta = 1/2
// would be the mid-point rule. With y = h D / M, D all viscous friction, theta = (3 + y) / (6 + y) = 1/2 + y/12 - ... is
// that of the exact decay e^-y to y^2, so that a sliding axis needs one sub-step a tick. The mean of v^2 is then w^2 + (v' -
// v)^2 / (12 + 2 y), and with it M (v'^2 - v^2) / 2 = M w (v' - v) - h D (v' - v)^2 / (12 + 2 y): work in = kinetic + stored
// + lost in every sub-step.
//
// In pre-sliding the bristles are springs, and over a sub-step neither is the spring's mean force that at the mean
// position, nor the mean velocity that of start and end. With kappa = h^2 K / (12 M), K the bristles' stiffness where they
// do not slip, both are mended: w = (v + v') / 2 + kappa w, and M (1 - kappa) (v' - v) / h = drive - ... . That is the
// fourth-order Fox-Goodwin (Numerov) rule; it keeps the energy of spring and mass exactly and halves the sub-steps.
//
// Coulomb friction is set-valued and stays so: a sub-step never runs across a reversal. Where the velocity would change
// its sign, the sub-step ends at the zero crossing, foreseen from the acceleration or found by a trial; there the axis
// sticks if the motor's Coulomb friction can hold the rest (it then stays exactly at rest), or sets off in the direction of
// the net force.

#include "plant/axis_model.h"
#include "plant/end_stop.h"

namespace feedtwin::plant {

/// Of a sub-step's first velocity: what is left then goes by the mean slope.
inline constexpr double near_its_reversal = 0.05;

namespace detail {

template <class Real>
struct Trial {
  Real mean_velocity_m_per_s, velocity_m_per_s;  ///< over the sub-step, at its end
  ContactsStep<Real> contacts;
  Real stop_force_N;
  Real h_s, per_h_Hz;
  Real per_theta;  ///< 1 / theta
  Real unswung;    ///< 1 - kappa
  Real arrest_J;   ///< kinetic energy left where a step to a reversal ends: the motor's Coulomb friction takes it up
  Real taken_s;    ///< h, or as far as the reversal
};

/// Net force at rest without the motor's Coulomb friction: what that friction would have to hold.
template <class Real, class Effects>
[[nodiscard]] inline Real net_force_at_rest_N(const AxisModel<Real>& model, const AxisState<Real>& state, Effects& effects,
                                              Real h_s) noexcept {
  const Real bristles = model.contacts.stiffness_force_N(state.screw_bristle_m, state.guide_bristle_m);
  const Real extra = effects.before(state, {Real{} + 1.0, Real{}, h_s, 1.0 / h_s}).force_N;
  return state.drive_N - bristles - extra - end_stop_load<Real>(model, state.position_m, Real{}, h_s).force_N;
}

/// kappa: what pre-sliding stiffness adds to the mid-point rule. Bounded, so that an absurd stiffness stays stable.
template <class Real>
[[nodiscard, gnu::always_inline]] inline Real kappa_of(const AxisModel<Real>& model, const ContactsStep<Real>& contacts,
                                                       Real h_s) noexcept {
  const Real stiffness_h = model.contacts.stiffness_force_N(contacts.screw_bristle_slope_s, contacts.guide_bristle_slope_s);
  const Real kappa = h_s * stiffness_h * ((1.0 / 12.0) * model.per_mass_per_kg);
  return smaller<Real>(larger<Real>(kappa, Real{}), Real{} + 0.25);
}

/// One Newton step from the predicted mean velocity.
template <class Real, class Effects>
[[nodiscard, gnu::always_inline]] inline Trial<Real> solve(const AxisModel<Real>& model, const AxisState<Real>& state,
                                                           Effects& effects, Real sign, Real h_s) noexcept {
  const Real per_h_Hz = 1.0 / h_s;
  const Real v = state.velocity_m_per_s;
  const MaskOf<Real> positive = sign > 0.0;
  const Real speed = larger<Real>(sign * (v + 0.5 * h_s * state.acceleration_m_per_s2), Real{});
  const Real w = sign * speed;
  const Sliding<Real> predicted{sign, speed, h_s, per_h_Hz};

  const ExtraLoad<Real> extra = effects.before(state, predicted);
  const ExtraLoad<Real> stop = end_stop_load<Real>(model, state.position_m, w, h_s);
  ContactsStep<Real> contacts = model.contacts.step(predicted, state.screw_bristle_m, state.guide_bristle_m, extra.scale);

  const Real damping = positive ? model.damping_pos_Ns_per_m : model.damping_neg_Ns_per_m;
  const Real coulomb = positive ? model.coulomb_pos_N : -model.coulomb_neg_N;
  const Real y = h_s * (positive ? model.damping_rate_pos_Hz : model.damping_rate_neg_Hz);
  const Real per_theta = (6.0 + y) / (3.0 + y);
  const Real unswung = 1.0 - kappa_of<Real>(model, contacts, h_s);
  const Real inertia = model.mass_kg * per_h_Hz * per_theta * unswung;
  const Real resisting =
      coulomb + damping * w + contacts.screw_force_N + contacts.guide_force_N + extra.force_N + stop.force_N;
  const Real slope = inertia * unswung + damping + contacts.screw_force_slope_Ns_per_m +
                     contacts.guide_force_slope_Ns_per_m + extra.force_slope_Ns_per_m + stop.force_slope_Ns_per_m;
  const Real correction = (state.drive_N - resisting - inertia * (unswung * w - v)) / slope;

  contacts.screw_force_N += contacts.screw_force_slope_Ns_per_m * correction;
  contacts.guide_force_N += contacts.guide_force_slope_Ns_per_m * correction;
  contacts.screw_bristle_m =
      within<Real>(contacts.screw_bristle_m + contacts.screw_bristle_slope_s * correction, contacts.screw_bristle_limit_m);
  contacts.guide_bristle_m =
      within<Real>(contacts.guide_bristle_m + contacts.guide_bristle_slope_s * correction, contacts.guide_bristle_limit_m);
  const Real mean = w + correction;
  return {mean,      v + per_theta * (unswung * mean - v),
          contacts,  stop.force_N + stop.force_slope_Ns_per_m * correction,
          h_s,       per_h_Hz,
          per_theta, unswung,
          Real{},    h_s};
}

/// The sub-step again, only the given fraction of it. Rare, so out of line: the common path stays in registers.
template <class Real, class Effects>
[[nodiscard, gnu::noinline]] Trial<Real> solve_part(const AxisModel<Real>& model, AxisState<Real> state, Effects& effects,
                                                    Real sign, const Trial<Real>& full, Real fraction,
                                                    MaskOf<Real> shortened) noexcept {
  const Real slope = (full.velocity_m_per_s - state.velocity_m_per_s) * full.per_h_Hz;
  state.acceleration_m_per_s2 = shortened ? slope : state.acceleration_m_per_s2;
  return solve<Real>(model, state, effects, sign, shortened ? full.h_s * fraction : full.h_s);
}

/// A trial that ends near its reversal ends at it: the last bit of velocity goes, with the time that it would take.
template <class Real>
[[gnu::always_inline]] inline void arrest(const AxisModel<Real>& model, Real start_m_per_s, Trial<Real>& trial,
                                          MaskOf<Real> there) noexcept {
  const Real v = trial.velocity_m_per_s;
  const Real left_J = 0.5 * model.mass_kg * v * v;
  trial.arrest_J = there ? left_J : Real{};
  trial.taken_s = there ? trial.h_s * (start_m_per_s / (start_m_per_s - v)) : trial.h_s;
  trial.velocity_m_per_s = there ? Real{} : v;
}

/// As far as the velocity's zero crossing.
template <class Real, class Effects>
[[nodiscard]] Trial<Real> solve_to_reversal(const AxisModel<Real>& model, const AxisState<Real>& state, Effects& effects,
                                            Real sign, const Trial<Real>& full, MaskOf<Real> shortened) noexcept {
  const Real v = state.velocity_m_per_s;
  const Real fraction = larger<Real>(v / (v - full.velocity_m_per_s), Real{} + 1e-9);
  Trial<Real> trial = solve_part<Real>(model, state, effects, sign, full, fraction, shortened);
  arrest<Real>(model, v, trial, shortened);
  return trial;
}

/// How far into the trial an end stop begins; 1 where none does. A sub-step that ran into a stop unhindered would make the
/// energy that the spring then gives back.
template <class Real>
[[nodiscard, gnu::always_inline]] inline Real fraction_to_stop(const AxisModel<Real>& model, Real position_m,
                                                               const Trial<Real>& trial) noexcept {
  const Real path_m = trial.mean_velocity_m_per_s * trial.h_s;
  const Real end_m = position_m + path_m;
  const auto above = (position_m < model.stop_high_m) & (end_m > model.stop_high_m);
  const auto below = (position_m > model.stop_low_m) & (end_m < model.stop_low_m);
  const Real one = Real{} + 1.0;
  if (!any(MaskOf<Real>(above | below))) return one;
  const Real edge_m = above ? model.stop_high_m : model.stop_low_m;
  return (above | below) ? larger<Real>((edge_m - position_m) / path_m, Real{} + 1e-6) : one;
}

/// @param w mean velocity, 0 in lanes that stand; @param ahead theta (v' - v), likewise
template <class Real>
[[gnu::always_inline]] inline void account(const AxisModel<Real>& model, const Trial<Real>& trial, MaskOf<Real> positive,
                                           Real w, Real ahead, AxisLosses<Real>& losses) noexcept {
  const Real path_m = w * trial.h_s;
  const Real forth_m = positive ? path_m : Real{};
  const Real back_m = path_m - forth_m;
  const Real spread = trial.h_s * ahead * ahead * (trial.per_theta * (trial.per_theta - 1.0) * (1.0 / 6.0));
  const Real speed_travel = w * path_m + spread;  // integral of v^2
  const Real speed_forth = positive ? speed_travel : Real{};
  const Real speed_back = speed_travel - speed_forth;
  losses.motor_J += model.coulomb_pos_N * forth_m - model.coulomb_neg_N * back_m +
                    (model.damping_pos_Ns_per_m * speed_forth + model.damping_neg_Ns_per_m * speed_back) + trial.arrest_J;
  losses.screw_J += trial.contacts.screw_force_N * path_m + trial.contacts.screw_viscous_Ns_per_m * spread;
  losses.guide_J += trial.contacts.guide_force_N * path_m + trial.contacts.guide_viscous_Ns_per_m * spread;
  losses.stop_J += trial.stop_force_N * path_m;
  losses.travel_pos_m += forth_m;
  losses.travel_neg_m -= back_m;
  losses.speed_travel_pos_m2_per_s += speed_forth;
  losses.speed_travel_neg_m2_per_s += speed_back;
}

/// One sub-step of at most h > 0; returns the time that it took. Lanes that have `ended` their tick stand still.
template <class Real, class Effects>
[[gnu::always_inline]] inline Real substep(const AxisModel<Real>& model, AxisState<Real>& state, AxisLosses<Real>& losses,
                                           Effects& effects, Real h_s, MaskOf<Real> ended) noexcept {
  using Mask = MaskOf<Real>;
  Mask idle = ended;
  Real sign = state.velocity_m_per_s > 0.0 ? Real{} + 1.0 : Real{} - 1.0;
  const Mask at_rest = state.velocity_m_per_s == 0.0;
  if (any(at_rest)) {
    const Real net = net_force_at_rest_N(model, state, effects, h_s);
    const Mask forward = net > model.coulomb_pos_N;
    const Mask backward = net < -model.coulomb_neg_N;
    const Mask stuck = at_rest & !(forward | backward);
    const Real beyond = forward ? net - model.coulomb_pos_N : net + model.coulomb_neg_N;
    sign = at_rest ? (forward ? Real{} + 1.0 : Real{} - 1.0) : sign;
    state.acceleration_m_per_s2 = at_rest ? beyond * model.per_mass_per_kg : state.acceleration_m_per_s2;
    state.acceleration_m_per_s2 = stuck ? Real{} : state.acceleration_m_per_s2;
    idle = idle | stuck;
    if (!any(Mask(!idle))) {
      const Real taken_s = ended ? Real{} : h_s;
      effects.after(state, Real{}, taken_s);
      return taken_s;
    }
  }

  // where the axis seems to reverse within the sub-step, as far as there
  const Real v = state.velocity_m_per_s;
  const Real stop_rate = -state.acceleration_m_per_s2 * h_s;
  const Mask slowing = (sign * stop_rate > sign * v) & !at_rest;
  Real trial_s = h_s;
  if (any(slowing)) trial_s = slowing ? h_s * larger<Real>(v / stop_rate, Real{} + 1e-6) : h_s;
  Trial<Real> trial = solve<Real>(model, state, effects, sign, trial_s);
  const Mask near = slowing & (absolute<Real>(trial.velocity_m_per_s) < near_its_reversal * absolute<Real>(v)) & !idle;
  if (any(near)) arrest<Real>(model, v, trial, near);
  const Mask crossing = (sign * trial.velocity_m_per_s < 0.0) & !idle;
  if (any(crossing)) {
    const Mask rebound = crossing & (state.velocity_m_per_s == 0.0);  // out of rest and back within one: a rest
    idle = idle | rebound;
    state.acceleration_m_per_s2 = rebound ? Real{} : state.acceleration_m_per_s2;
    trial = solve_to_reversal<Real>(model, state, effects, sign, trial, crossing & !rebound);
  }
  const Real to_stop = fraction_to_stop<Real>(model, state.position_m, trial);
  const Mask entering = (to_stop < 1.0) & !idle;
  if (any(entering)) trial = solve_part<Real>(model, state, effects, sign, trial, to_stop, entering);
  const Real w = idle ? Real{} : trial.mean_velocity_m_per_s;
  const Real ahead = idle ? Real{} : trial.unswung * w - state.velocity_m_per_s;
  account<Real>(model, trial, sign > 0.0, w, ahead, losses);
  const Real acceleration = trial.per_theta * ahead * trial.per_h_Hz;
  state.position_m += w * trial.h_s;
  state.acceleration_m_per_s2 = idle ? state.acceleration_m_per_s2 : acceleration;
  state.velocity_m_per_s = idle ? state.velocity_m_per_s : trial.velocity_m_per_s;
  state.screw_bristle_m = idle ? state.screw_bristle_m : trial.contacts.screw_bristle_m;
  state.guide_bristle_m = idle ? state.guide_bristle_m : trial.contacts.guide_bristle_m;
  effects.after(state, w, ended ? Real{} : trial.h_s);
  return ended ? Real{} : trial.taken_s;
}

}  // namespace detail

}  // namespace feedtwin::plant
