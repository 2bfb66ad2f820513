#include "plant/effects/coupling.h"

#include "plant/effects/contact_spring.h"

namespace feedtwin::plant {
namespace {

LugreSide<double> lane(const LugreSide<Doubles<2>>& side, int i) noexcept {
  return {side.coulomb_N[i], side.stribeck_rise_N[i], side.inverse_stribeck_s_per_m[i], side.viscous_Ns_per_m[i]};
}

LugreSide<double> scaled(LugreSide<double> side, const FrictionScale<double>& scale) noexcept {
  side.coulomb_N *= scale.guide_sliding;
  side.stribeck_rise_N *= scale.guide_sliding;
  side.viscous_Ns_per_m *= scale.guide_viscous;
  return side;
}

}  // namespace

Coupling::Coupling(const CouplingParameters& parameters, const AxisModel<double>& model) noexcept
    : parameters_(parameters),
      half_gap_m_(0.5 * parameters.gap_m),
      mass_kg_(model.table_mass_kg),
      rate_squared_per_s2_(parameters.stiffness_N_per_m *
                           (1.0 / model.table_mass_kg + 1.0 / (model.mass_kg - model.table_mass_kg))),
      stops_(model),
      guide_{model.contacts.both.bristle.stiffness_N_per_m[1], model.contacts.both.bristle.compliance_m_per_N[1],
             model.contacts.both.bristle.damping_Ns_per_m[1]},
      pos_(lane(model.contacts.both.pos, 1)),
      neg_(lane(model.contacts.both.neg, 1)) {}

void Coupling::place(double position_m, double velocity_m_per_s) noexcept {
  position_m_ = position_m;
  velocity_m_per_s_ = velocity_m_per_s;
  acceleration_m_per_s2_ = bristle_m_ = depth_m_ = 0.0;
}

void Coupling::set_sub_step(double h_s) noexcept {
  const double k = parameters_.stiffness_N_per_m, square = rate_squared_per_s2_ * h_s * h_s;
  const double too_long = square > longest_swing ? 1.0 - longest_swing / square : 0.0;
  trial_.h_s = h_s;
  trial_.per_h_Hz = 1.0 / h_s;
  trial_.end_weight = 0.5 + 0.5 * too_long;
  trial_.inertia_Ns_per_m = mass_kg_ * trial_.per_h_Hz / trial_.end_weight;
  trial_.reduced_Ns_per_m = 2.0 * k / rate_squared_per_s2_ * trial_.per_h_Hz;
  trial_.damping_Ns_per_m = parameters_.damping_Ns_per_m + 0.5 * k * h_s * too_long;
  trial_.quarter_square = 0.25 * square;
  trial_.resolved = 1.0 - too_long;
}

/// What the spring's swing adds to the mid-point rule. @param bearing how much of the spring acts, 0 to 1
Coupling::ContactForce Coupling::swung(ContactForce contact, double bearing, double rate_m_per_s) const noexcept {
  const double most = half_gap_m_ > 0.0 ? 0.25 : 0.75;  // an absurd stiffness stays stable, and where flanks are met
  const double square = trial_.quarter_square * bearing;
  const double exact = square * (1.0 / 3.0 + square * (1.0 / 45.0 + square * (2.0 / 945.0 + square / 4725.0)));
  contact.kappa = std::min(most, trial_.resolved * exact);
  const double inertia = contact.kappa * trial_.reduced_Ns_per_m, kept = 1.0 - contact.kappa;
  contact.force_N -= inertia * (kept * rate_m_per_s - trial_.rate_before);
  contact.slope_Ns_per_m -= inertia * kept;
  return contact;
}

/// Which flank bears all the sub-step, and presses with half the spring's force at least; none also where no flank is met.
Coupling::Flank Coupling::flank_at(double start_m, double rate_m_per_s) const noexcept {
  if (half_gap_m_ == 0.0) return Flank::high;
  const double s_m = rate_m_per_s * trial_.h_s, d_m = trial_.screw_x - position_m_, end_m = beyond_gap_m(d_m + s_m);
  if (start_m == 0.0 && end_m == 0.0 && std::abs(s_m) < half_gap_m_) return Flank::none;
  if (start_m * end_m <= 0.0) return Flank::changing;
  const double half_spring_N = 0.25 * parameters_.stiffness_N_per_m * (start_m + end_m);
  const double damper_N = trial_.damping_Ns_per_m * rate_m_per_s;
  const bool high = start_m > 0.0, presses = high ? damper_N >= -half_spring_N : damper_N <= -half_spring_N;
  return !presses ? Flank::changing : high ? Flank::high : Flank::low;
}

/// The damper works as long as a flank bears: its mean rate is that of the depth, and nothing jumps where a flank is met.
Coupling::ContactForce Coupling::contact(double rate_m_per_s) const noexcept {
  const double k = parameters_.stiffness_N_per_m, c = trial_.damping_Ns_per_m, s_m = rate_m_per_s * trial_.h_s;
  const double whole = 0.5 * k * trial_.h_s;  // slope of a spring that bears all the way
  const double d_m = trial_.screw_x - position_m_, start_m = beyond_gap_m(d_m);
  const Flank flank = flank_at(start_m, rate_m_per_s);
  if (flank == Flank::none) return {.flank = flank};
  if (flank != Flank::changing)
    return swung({.force_N = k * (start_m + 0.5 * s_m) + c * rate_m_per_s, .slope_Ns_per_m = whole + c, .flank = flank}, 1.0,
                 rate_m_per_s);
  const double middle_m = beyond_gap_m(d_m + 0.5 * s_m), end_m = beyond_gap_m(d_m + s_m);
  const SpringMean spring = spring_mean(k, start_m, middle_m, end_m, s_m);
  const double slope = spring.slope_N_per_m * trial_.h_s;
  const double force_N = spring.force_N + c * (end_m - start_m) * trial_.per_h_Hz;
  if (force_N * (start_m + end_m) < 0.0) return {};
  const double pressing = spring.force_N != 0.0 ? std::clamp(2.0 * force_N / spring.force_N, 0.0, 1.0) : 1.0;
  return swung({.force_N = force_N, .slope_Ns_per_m = slope + (end_m != 0.0 ? c : 0.0)}, pressing * slope / whole,
               rate_m_per_s);
}

/// All of the table's equation but the coupling, linear about w_table.
void Coupling::balance(double w_table, const EffectLoad& load, double load_at, const FrictionScale<double>& scale) noexcept {
  const double sign = w_table < 0.0 ? -1.0 : 1.0;
  const double inertia = trial_.inertia_Ns_per_m;
  trial_.guide = lugre_step<double>(guide_, scaled(w_table < 0.0 ? neg_ : pos_, scale), sign, std::abs(w_table), bristle_m_,
                                    trial_.h_s, trial_.per_h_Hz);
  trial_.stop = end_stop_load<double>(stops_, position_m_, w_table, trial_.h_s);
  trial_.table_w = w_table;
  trial_.others_N = inertia * (w_table - velocity_m_per_s_) + trial_.guide.force_N + trial_.stop.force_N + load.force_N +
                    load.slope_Ns_per_m * (w_table - load_at);
  trial_.others_slope = inertia + trial_.guide.force_slope_Ns_per_m + trial_.stop.force_slope_Ns_per_m + load.slope_Ns_per_m;
}

/// The table's mean velocity for the screw's, with the rest of its equation linear as balance() left it.
Coupling::Settled Coupling::settle(double screw_w, double table_w) const noexcept {
  constexpr int passes = 6;  // linear by pieces and monotone: ends as soon as the flank is right
  const double start_m = beyond_gap_m(trial_.screw_x - position_m_);
  ContactForce spring;
  for (int i = 0; i < passes; ++i) {
    spring = contact(screw_w - table_w);
    const double swung = trial_.inertia_Ns_per_m * spring.kappa;
    const double step = (spring.force_N - swung * (screw_w - table_w) - table_side_N(table_w)) /
                        (trial_.others_slope + spring.slope_Ns_per_m - swung);
    table_w += step;
    if (spring.flank != Flank::changing && spring.flank == flank_at(start_m, screw_w - table_w)) break;
    if (std::abs(step) < 1e-7 * std::abs(table_w) + 1e-10) break;
  }
  return {table_w, spring.slope_Ns_per_m, spring.kappa};
}

EffectLoad Coupling::respond(const EffectMotion& screw, double screw_before_m_per_s, const EffectLoad& load,
                             const FrictionScale<double>& scale) noexcept FEEDTWIN_REALTIME {
  trial_.screw_x = screw.position_m;
  trial_.screw_w = screw.velocity_m_per_s;
  trial_.rate_before = screw_before_m_per_s - velocity_m_per_s_;
  if (screw.h_s != trial_.h_s) set_sub_step(screw.h_s);
  const double predicted = predicted_velocity_m_per_s(screw.h_s);
  balance(predicted, load, predicted, scale);
  Settled table = settle(screw.velocity_m_per_s, predicted);
  if (std::abs(table.w - predicted) > 0.05 * std::abs(predicted)) {  // friction again, at the velocity that was found
    balance(table.w, load, predicted, scale);
    table = settle(screw.velocity_m_per_s, table.w);
  }
  const double K = table.slope_Ns_per_m, swung = trial_.inertia_Ns_per_m * table.kappa;
  trial_.settled_w = table.w;
  trial_.force = {table_side_N(table.w) + swung * (screw.velocity_m_per_s - table.w),
                  K * trial_.others_slope / (trial_.others_slope + K - swung)};
  return trial_.force;
}

double Coupling::finish(double screw_velocity_m_per_s) noexcept FEEDTWIN_REALTIME {
  const double given_N = trial_.force.force_N + trial_.force.slope_Ns_per_m * (screw_velocity_m_per_s - trial_.screw_w);
  const Settled table = settle(screw_velocity_m_per_s, trial_.settled_w);
  const double w = table.w, u = w - trial_.table_w;
  const double path_m = w * trial_.h_s;
  const double gained = (w + table.kappa * (screw_velocity_m_per_s - w) - velocity_m_per_s_) / trial_.end_weight;
  const double inertial_J = trial_.inertia_Ns_per_m * (w - velocity_m_per_s_) * path_m;
  const double kinetic_J = mass_kg_ * gained * (velocity_m_per_s_ + 0.5 * gained);
  guide_J_ += (trial_.guide.force_N + trial_.guide.force_slope_Ns_per_m * u) * path_m;
  stop_J_ += (trial_.stop.force_N + trial_.stop.force_slope_Ns_per_m * u) * path_m;
  own_J_ += given_N * screw_velocity_m_per_s * trial_.h_s - table_side_N(w) * path_m + inertial_J - kinetic_J;
  bristle_m_ = trial_.guide.bristle_m + trial_.guide.bristle_slope_s * u;
  position_m_ += path_m;
  acceleration_m_per_s2_ = gained * trial_.per_h_Hz;
  velocity_m_per_s_ += gained;
  return w;
}

double Coupling::force_N(double screw_position_m, double screw_velocity_m_per_s) const noexcept FEEDTWIN_REALTIME {
  const double depth_m = beyond_gap_m(screw_position_m - position_m_);
  if (half_gap_m_ > 0.0 && depth_m == 0.0) return 0.0;
  const double rate = screw_velocity_m_per_s - velocity_m_per_s_;
  const double force_N = parameters_.stiffness_N_per_m * depth_m + parameters_.damping_Ns_per_m * rate;
  return half_gap_m_ > 0.0 && force_N * depth_m < 0.0 ? 0.0 : force_N;
}

}  // namespace feedtwin::plant
