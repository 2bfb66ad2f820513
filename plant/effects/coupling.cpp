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
  acceleration_m_per_s2_ = bristle_m_ = 0.0;
}

ContactForce Coupling::contact(double d_m, double rate_m_per_s, double h_s) const noexcept {
  const double k = parameters_.stiffness_N_per_m;
  const double s_m = rate_m_per_s * h_s;
  const double middle_m = beyond_gap_m(d_m + 0.5 * s_m);
  const SpringMean spring = spring_mean(k, beyond_gap_m(d_m), middle_m, beyond_gap_m(d_m + s_m), s_m);
  const double force_N = spring.force_N;
  const double slope = spring.slope_N_per_m * h_s;
  if (middle_m != 0.0) {
    const double damping = parameters_.damping_Ns_per_m + 0.5 * k * h_s * too_long(h_s);
    const double total_N = force_N + damping * rate_m_per_s;
    if (total_N * middle_m < 0.0) return {0.0, 0.0};
    return {total_N, slope + damping};
  }
  return {force_N, slope};
}

/// All of the table's equation but the coupling, linear about w_table.
void Coupling::balance(double w_table, const EffectLoad& load, double load_at, const FrictionScale<double>& scale) noexcept {
  const double sign = w_table < 0.0 ? -1.0 : 1.0;
  const double per_h_Hz = 1.0 / trial_.h_s;
  const double inertia = mass_kg_ * per_h_Hz / end_weight(trial_.h_s);
  trial_.guide = lugre_step<double>(guide_, scaled(w_table < 0.0 ? neg_ : pos_, scale), sign, std::abs(w_table), bristle_m_,
                                    trial_.h_s, per_h_Hz);
  trial_.stop = end_stop_load<double>(stops_, position_m_, w_table, trial_.h_s);
  trial_.table_w = w_table;
  trial_.others_N = inertia * (w_table - velocity_m_per_s_) + trial_.guide.force_N + trial_.stop.force_N + load.force_N +
                    load.slope_Ns_per_m * (w_table - load_at);
  trial_.others_slope = inertia + trial_.guide.force_slope_Ns_per_m + trial_.stop.force_slope_Ns_per_m + load.slope_Ns_per_m;
}

/// The table's mean velocity for the screw's, with the rest of its equation linear as balance() left it.
double Coupling::settle(double screw_w, double table_w) noexcept {
  constexpr int passes = 6;  // piecewise linear and monotone: ends as soon as the flank is right
  const double d_m = trial_.screw_x - position_m_;
  for (int i = 0; i < passes; ++i) {
    const ContactForce spring = contact(d_m, screw_w - table_w, trial_.h_s);
    const double step = (spring.force_N - table_side_N(table_w)) / (trial_.others_slope + spring.slope_Ns_per_m);
    table_w += step;
    if (std::abs(step) < 1e-9 * std::abs(table_w) + 1e-12) break;
  }
  return table_w;
}

EffectLoad Coupling::respond(const EffectMotion& screw, const EffectLoad& load,
                             const FrictionScale<double>& scale) noexcept FEEDTWIN_REALTIME {
  trial_.screw_x = screw.position_m;
  trial_.screw_w = screw.velocity_m_per_s;
  trial_.h_s = screw.h_s;
  const double predicted = predicted_velocity_m_per_s(screw.h_s);
  balance(predicted, load, predicted, scale);
  double table_w = settle(screw.velocity_m_per_s, predicted);
  if (std::abs(table_w - predicted) > 0.05 * std::abs(predicted)) {  // friction again, at the velocity that was found
    balance(table_w, load, predicted, scale);
    table_w = settle(screw.velocity_m_per_s, table_w);
  }
  const double d_m = screw.position_m - position_m_;
  const double K = contact(d_m, screw.velocity_m_per_s - table_w, screw.h_s).slope_Ns_per_m;
  trial_.settled_w = table_w;
  trial_.force = {table_side_N(table_w), K * trial_.others_slope / (trial_.others_slope + K)};
  return trial_.force;
}

double Coupling::finish(double screw_velocity_m_per_s) noexcept FEEDTWIN_REALTIME {
  const double given_N = trial_.force.force_N + trial_.force.slope_Ns_per_m * (screw_velocity_m_per_s - trial_.screw_w);
  const double w = settle(screw_velocity_m_per_s, trial_.settled_w);
  const double u = w - trial_.table_w;
  const double path_m = w * trial_.h_s;
  const double gained = (w - velocity_m_per_s_) / end_weight(trial_.h_s);
  const double inertial_J = mass_kg_ * gained * w;
  const double kinetic_J = mass_kg_ * gained * (velocity_m_per_s_ + 0.5 * gained);
  guide_J_ += (trial_.guide.force_N + trial_.guide.force_slope_Ns_per_m * u) * path_m;
  stop_J_ += (trial_.stop.force_N + trial_.stop.force_slope_Ns_per_m * u) * path_m;
  own_J_ += given_N * screw_velocity_m_per_s * trial_.h_s - table_side_N(w) * path_m + inertial_J - kinetic_J;
  bristle_m_ = trial_.guide.bristle_m + trial_.guide.bristle_slope_s * u;
  position_m_ += path_m;
  acceleration_m_per_s2_ = gained / trial_.h_s;
  velocity_m_per_s_ += gained;
  return w;
}

double Coupling::force_N(double screw_position_m, double screw_velocity_m_per_s) const noexcept FEEDTWIN_REALTIME {
  constexpr double instant_s = 1e-9;
  return contact(screw_position_m - position_m_, screw_velocity_m_per_s - velocity_m_per_s_, instant_s).force_N;
}

}  // namespace feedtwin::plant
