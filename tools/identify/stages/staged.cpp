#include "tools/identify/stages/staged.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/parameter_table.h"
#include "tools/identify/stages/by_genetic.h"
#include "tools/identify/stages/inverse_lugre.h"
#include "tools/identify/stages/sliding.h"

namespace feedtwin::tools {
namespace {

using Component = std::vector<double> ComponentForces::*;

constexpr double settled_lengths = 8.0;   // bristle lengths of travel after which sliding counts as steady
constexpr double stribeck_lengths = 4.0;  // Stribeck velocities above which Coulomb and viscous friction are all there is
constexpr double least_curve_m_per_s = 1e-4;
constexpr double steady_share = 0.1;      // change of speed within a bristle length above which sliding is not steady
constexpr double mass_told_share = 0.05;  // deviation below which a mass counts as told

/// Puts a value into the axis and remembers its key.
void put(StagedFit& into, const char* key, double value) {
  const auto* entry = plant::find_parameter(key);
  entry->in(into.axis) = std::clamp(value, entry->lowest, entry->highest);
  into.keys.emplace_back(key);
}

double slowest_sliding(const plant::AxisParameters& axis) {
  const auto largest = [](const plant::Directional& v) { return std::max(v.pos, v.neg); };
  return stribeck_lengths * std::max(largest(axis.ball_screw.stribeck_m_per_s), largest(axis.guide.stribeck_m_per_s));
}

double bristle_length_m(const plant::LugreParameters& p) {
  return std::max(p.static_N.pos, p.static_N.neg) / p.stiffness_N_per_m;
}

std::optional<SlidingFit> sliding_of(std::span<const ComponentForces> runs, Component component, const StagedFit& so_far) {
  const double settled_m =
      settled_lengths * std::max(bristle_length_m(so_far.axis.ball_screw), bristle_length_m(so_far.axis.guide));
  return fit_sliding(runs, component, slowest_sliding(so_far.axis), settled_m);
}

void find_electrical(std::span<const Recording> recordings, StagedFit& into) {
  into.electrical = fit_electrical_loss(recordings, into.axis);
  if (!into.electrical) {
    into.notes.emplace_back("(a) electrical loss: no power meter, or too few readings to tell it");
    return;
  }
  put(into, "motor.ke0_W", into.electrical->idle_W);
  put(into, "motor.ke1_pos_Ws_per_m", into.electrical->linear_Ws_per_m.pos);
  put(into, "motor.ke1_neg_Ws_per_m", into.electrical->linear_Ws_per_m.neg);
  put(into, "motor.ke2_pos_Ws2_per_m2", into.electrical->quadratic_Ws2_per_m2.pos);
  put(into, "motor.ke2_neg_Ws2_per_m2", into.electrical->quadratic_Ws2_per_m2.neg);
}

void find_motor(std::span<const ComponentForces> runs, StagedFit& into) {
  const auto motor = sliding_of(runs, &ComponentForces::motor_N, into);
  if (!motor) {
    into.notes.emplace_back("(b) motor friction: no torque sensor, or too little sliding to tell it");
    return;
  }
  const double per_k2 = std::pow(into.axis.axis.lead_m / (2.0 * std::numbers::pi), 2);
  if (motor->mass_deviation_kg < mass_told_share * motor->mass_kg) put(into, "motor.inertia_kgm2", motor->mass_kg * per_k2);
  put(into, "motor.damping_pos_Nms", motor->viscous_Ns_per_m.pos * per_k2);
  put(into, "motor.damping_neg_Nms", motor->viscous_Ns_per_m.neg * per_k2);
  put(into, "motor.coulomb_pos_N", motor->coulomb_N.pos);
  put(into, "motor.coulomb_neg_N", motor->coulomb_N.neg);
  into.motor_found = true;
}

/// How much the speed changes, as a share, within a bristle length; over 20 samples, for the encoder's grid not to count.
double unsteadiness(const ComponentForces& run, std::size_t i, double length_m) {
  constexpr std::size_t reach = 10;
  if (i < reach || i + reach >= run.velocity_m_per_s.size()) return 1.0;
  const auto& v = run.velocity_m_per_s;
  const double acceleration = (v[i + reach] - v[i - reach]) / (2.0 * reach * run.sample_s);
  return std::abs(acceleration) * length_m / (v[i] * v[i]);
}

/// Steady sliding of one direction, freed of inertia.
StribeckCurve curve_of(std::span<const ComponentForces> runs, Component component, double mass_kg, double sign,
                       double length_m) {
  std::vector<double> speed, force;
  for (const auto& run : runs) {
    const auto& force_N = run.*component;
    for (std::size_t i = 0; i + 2 < force_N.size(); ++i) {
      const double v = sign * run.velocity_m_per_s[i];
      if (v < least_curve_m_per_s || run.since_reversal_m[i] < settled_lengths * length_m) continue;
      if (unsteadiness(run, i, length_m) > steady_share) continue;
      speed.push_back(v);
      force.push_back(sign * (force_N[i] - mass_kg * run.acceleration_m_per_s2[i]));
    }
  }
  return binned_curve(speed, force);
}

struct ContactKeys {
  const char *name, *mass, *coulomb[2], *breakaway[2], *stribeck[2], *viscous[2], *stiffness, *damping;
};
constexpr ContactKeys screw_keys{"ball_screw",
                                 "ball_screw.inertia_kgm2",
                                 {"ball_screw.coulomb_pos_N", "ball_screw.coulomb_neg_N"},
                                 {"ball_screw.static_pos_N", "ball_screw.static_neg_N"},
                                 {"ball_screw.stribeck_pos_m_per_s", "ball_screw.stribeck_neg_m_per_s"},
                                 {"ball_screw.viscous_pos_Ns_per_m", "ball_screw.viscous_neg_Ns_per_m"},
                                 "ball_screw.sigma0_N_per_m",
                                 "ball_screw.sigma1_Ns_per_m"};
constexpr ContactKeys guide_keys{"guide",
                                 "guide.mass_kg",
                                 {"guide.coulomb_pos_N", "guide.coulomb_neg_N"},
                                 {"guide.static_pos_N", "guide.static_neg_N"},
                                 {"guide.stribeck_pos_m_per_s", "guide.stribeck_neg_m_per_s"},
                                 {"guide.viscous_pos_Ns_per_m", "guide.viscous_neg_Ns_per_m"},
                                 "guide.sigma0_N_per_m",
                                 "guide.sigma1_Ns_per_m"};

/// Stages (c) and (d) of one contact. @param kg_per_unit of the number that the axis file has for its mass
void find_contact(std::span<const ComponentForces> runs, Component component, const ContactKeys& keys, double kg_per_unit,
                  plant::LugreParameters plant::AxisParameters::* friction, StageSearch search, StagedFit& into) {
  const auto any = [&](const ComponentForces& run) { return !(run.*component).empty(); };
  if (std::ranges::none_of(runs, any)) {
    into.notes.push_back(std::string("(c), (d) ") + keys.name + ": no sensor divides it from the rest");
    return;
  }
  ContactStages stages;
  stages.component = keys.name;
  const auto sliding = sliding_of(runs, component, into);
  if (sliding && sliding->mass_deviation_kg < mass_told_share * sliding->mass_kg)
    put(into, keys.mass, sliding->mass_kg / kg_per_unit);
  const double mass_kg = plant::find_parameter(keys.mass)->in(into.axis) * kg_per_unit;
  const double length_m = bristle_length_m(into.axis.*friction);
  for (const int side : {0, 1}) {
    auto& curve = side == 0 ? stages.curve_pos : stages.curve_neg;
    curve = curve_of(runs, component, mass_kg, side == 0 ? 1.0 : -1.0, length_m);
    const auto fit = search == StageSearch::genetic ? fit_stribeck_curve_by_genetic(curve) : fit_stribeck_curve(curve);
    (side == 0 ? stages.sliding_pos : stages.sliding_neg) = fit;
    if (!fit) continue;
    put(into, keys.coulomb[side], fit->coulomb_N);
    put(into, keys.breakaway[side], fit->static_N);
    put(into, keys.stribeck[side], fit->stribeck_m_per_s);
    put(into, keys.viscous[side], fit->viscous_Ns_per_m);
  }
  if (stages.sliding_pos && stages.sliding_neg) {
    const auto& found = into.axis.*friction;
    stages.presliding = search == StageSearch::genetic ? fit_hysteresis_by_genetic(runs, component, mass_kg, found)
                                                       : fit_hysteresis(runs, component, mass_kg, found);
  }
  if (stages.presliding) {
    put(into, keys.stiffness, stages.presliding->stiffness_N_per_m);
    put(into, keys.damping, stages.presliding->damping_Ns_per_m);
  } else {
    into.notes.push_back(std::string("(d) ") + keys.name + ": nothing near enough to a reversal");
  }
  into.contacts.push_back(std::move(stages));
}

/// No sensor: the ball screw takes what the command says of mass and sliding as a whole.
void give_all_to_the_screw(std::span<const ComponentForces> runs, StagedFit& into) {
  const auto total = sliding_of(runs, &ComponentForces::total_N, into);
  if (!total) {
    into.notes.emplace_back("too little sliding to start from: the axis file's numbers stay");
    return;
  }
  const double k = 2.0 * std::numbers::pi / into.axis.axis.lead_m;
  const auto& axis = into.axis;
  const double others_kg = axis.motor.inertia_kgm2 * k * k + axis.guide_mass_kg;
  if (total->mass_deviation_kg < mass_told_share * total->mass_kg && total->mass_kg > others_kg)
    put(into, "ball_screw.inertia_kgm2", (total->mass_kg - others_kg) / (k * k));
  for (const int side : {0, 1}) {
    const auto direction = side == 0 ? &plant::Directional::pos : &plant::Directional::neg;
    const double coulomb_N = total->coulomb_N.*direction - axis.motor.coulomb_N.*direction - axis.guide.coulomb_N.*direction;
    const double viscous = total->viscous_Ns_per_m.*direction - axis.motor.damping_Nms.*direction * k * k -
                           axis.guide.viscous_Ns_per_m.*direction;
    const double rise_N = axis.ball_screw.static_N.*direction - axis.ball_screw.coulomb_N.*direction;
    put(into, screw_keys.coulomb[side], coulomb_N);
    put(into, screw_keys.breakaway[side], coulomb_N + rise_N);
    put(into, screw_keys.viscous[side], viscous);
  }
  // what the reversals say, one number for both directions
  const auto& screw = into.axis.ball_screw;
  const auto lugre = InverseLugre(runs).fit(
      {screw.coulomb_N.pos / screw.stiffness_N_per_m, screw.static_N.pos / screw.coulomb_N.pos, screw.stribeck_m_per_s.pos});
  if (!lugre || lugre->damping_Ns_per_m < 0.0) return;
  for (const int side : {0, 1}) {
    const auto direction = side == 0 ? &plant::Directional::pos : &plant::Directional::neg;
    put(into, screw_keys.breakaway[side], screw.coulomb_N.*direction + lugre->static_N - lugre->coulomb_N);
    put(into, screw_keys.stribeck[side], lugre->stribeck_m_per_s);
  }
  put(into, screw_keys.stiffness, lugre->stiffness_N_per_m);
  put(into, screw_keys.damping, lugre->damping_Ns_per_m);
}

}  // namespace

StagedFit identify_by_stages(const plant::AxisParameters& nominal, std::span<const Recording> recordings,
                             StageSearch search) {
  StagedFit fit;
  fit.axis = nominal;
  std::vector<ComponentForces> runs;
  for (const auto& recording : recordings) runs.push_back(component_forces(recording, nominal.axis.lead_m));
  find_electrical(recordings, fit);
  const bool divided =
      std::ranges::any_of(runs, [](const auto& run) { return !run.motor_N.empty() || !run.guide_N.empty(); });
  if (!divided) {
    give_all_to_the_screw(runs, fit);
    return fit;
  }
  find_motor(runs, fit);
  const double k = 2.0 * std::numbers::pi / nominal.axis.lead_m;
  find_contact(runs, &ComponentForces::screw_N, screw_keys, k * k, &plant::AxisParameters::ball_screw, search, fit);
  find_contact(runs, &ComponentForces::guide_N, guide_keys, 1.0, &plant::AxisParameters::guide, search, fit);
  return fit;
}

}  // namespace feedtwin::tools
