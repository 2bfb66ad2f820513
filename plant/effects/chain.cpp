#include "plant/effects/chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plant/effects/registry.h"

namespace feedtwin::plant {
namespace {

const EffectEntry& entry_of(const EffectSetting& setting) {
  const auto* entry = find_effect(setting.id);
  if (entry == nullptr) throw std::invalid_argument("no effect has the id " + setting.id);
  const auto lists = static_cast<std::size_t>(std::ranges::count_if(entry->parameters, &EffectParameter::list));
  if (setting.lists.size() != lists || setting.values.size() != entry->parameters.size() - lists) {
    throw std::invalid_argument("wrong count of parameters for the effect " + setting.id);
  }
  if (entry->problem != nullptr) {
    if (const std::string problem = entry->problem(setting); !problem.empty()) {
      throw std::invalid_argument(setting.id + ": " + problem);
    }
  }
  return *entry;
}

/// Friction is scaled, never switched off or turned around.
double bounded(double scale) noexcept {
  return std::clamp(scale, 0.01, 100.0);
}

}  // namespace

AxisParameters adapted(const AxisParameters& parameters) {
  AxisParameters axis = parameters;
  for (const auto& setting : parameters.effects) {
    const auto& entry = entry_of(setting);
    if (entry.adapt != nullptr) entry.adapt(axis, setting);
  }
  return axis;
}

EffectChain::EffectChain(const AxisParameters& axis, const AxisModel<double>& model) {
  for (const auto& setting : axis.effects) (void)entry_of(setting);
  for (const auto& entry : effect_registry()) {  // in its order, which is the signal's
    const bool at_table = entry.component == EffectComponent::guide || entry.component == EffectComponent::load ||
                          (entry.of_contact && axis.laws_on_guide());
    for (const auto& setting : axis.effects) {
      if (setting.id != entry.id || entry.make == nullptr) continue;
      links_.push_back({&entry, entry.make({axis, model}, setting), at_table, {}});
    }
  }

  CouplingParameters coupling;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const auto& hooks = links_[i].entry->hooks;
    if (hooks.join) links_[i].effect->join(coupling);
    if (hooks.tick) ticking_.push_back(i);
    if (hooks.torque) torque_.push_back(i);
    if (hooks.load) (links_[i].at_table ? table_loads_ : screw_loads_).push_back(i);
    if (hooks.scale) scaling_.push_back(i);
    if (hooks.advance) advancing_.push_back(i);
    if (hooks.sense) sensing_.push_back(i);
    if (hooks.counts) counting_.push_back(i);
    if (hooks.power) power_.push_back(i);
    if (hooks.show) showing_.push_back(i);
    if (hooks.show_forces) showing_forces_.push_back(i);
    if (hooks.take_forces) taking_forces_.push_back(i);
  }
  if (coupling.stiffness_N_per_m > 0.0) coupling_.emplace(coupling, model);
}

AxisModel<double> EffectChain::driven(const AxisModel<double>& model) const noexcept {
  AxisModel<double> without = model;
  if (std::ranges::any_of(links_, [](const Link& link) { return link.effect->is_motor_friction(); }))
    without.coulomb_pos_N = without.coulomb_neg_N = 0.0;
  if (!coupling_) return without;
  without.mass_kg -= model.table_mass_kg;
  without.per_mass_per_kg = 1.0 / without.mass_kg;
  without.table_mass_kg = 0.0;
  auto& both = without.contacts.both;
  without.damping_rate_pos_Hz = (model.damping_pos_Ns_per_m + both.pos.viscous_Ns_per_m[0]) / without.mass_kg;
  without.damping_rate_neg_Hz = (model.damping_neg_Ns_per_m + both.neg.viscous_Ns_per_m[0]) / without.mass_kg;
  // a guide without bristles gives no force
  for (auto* side : {&both.pos, &both.neg}) {
    side->coulomb_N[1] = 1.0;
    side->stribeck_rise_N[1] = 0.0;
    side->viscous_Ns_per_m[1] = 0.0;
  }
  both.bristle.stiffness_N_per_m[1] = both.bristle.compliance_m_per_N[1] = both.bristle.damping_Ns_per_m[1] = 0.0;
  constexpr double nowhere_m = 1e9;
  without.stop_low_m = -nowhere_m;
  without.stop_high_m = nowhere_m;
  return without;
}

Resolution EffectChain::at_least(Resolution resolution, bool calm) const noexcept {
  constexpr int waving = 3;  // 0.1 m/s and twelve periods a revolution: half a radian a sub-step
  const auto moves = [](const Link& link) { return link.entry->hooks.load || link.entry->hooks.advance; };
  const bool quiet = std::ranges::none_of(links_, moves);
  const bool even = std::ranges::all_of(
      links_, [&](const Link& link) { return moves(link) ? link.entry->even_in_motion : !link.entry->uneven_in_motion; });
  const int swing = coupling_ ? coupling_->substeps(resolution.swinging, calm || !coupling_->has_gap()) : 1;
  const int in_motion = std::max(swing, even ? 1 : waving);
  resolution.sliding = std::max(resolution.sliding, in_motion);
  resolution.settling = std::max(resolution.settling, in_motion);
  resolution.reversing = std::max(resolution.reversing, 2 * std::max(swing, quiet && !coupling_ ? 1 : waving));
  return resolution;
}

Resolution EffectChain::at_least_in_a_calm_tick(Resolution resolution) const noexcept {
  Resolution calm = at_least(resolution, true);
  calm.reversing = at_least(resolution, false).reversing;  // where a load turns round its flank is left
  return calm;
}

void EffectChain::reset(double position_m, double velocity_m_per_s) noexcept {
  time_s_ = tick_phase_s_ = 0.0;
  if (coupling_) coupling_->place(position_m, velocity_m_per_s);
  for (auto& link : links_) link.effect->reset(position_m);
}

double EffectChain::start_tick(double torque_Nm, double cutting_force_N, const TickStart& start) noexcept FEEDTWIN_REALTIME {
  time_s_ = start.time_s;
  tick_phase_s_ = 0.0;
  cutting_force_N_ = cutting_force_N;
  for (const std::size_t i : ticking_) links_[i].effect->tick(start);
  for (const std::size_t i : torque_) {
    auto& effect = *links_[i].effect;
    const double shaped_Nm = effect.torque_Nm(torque_Nm, start);
    if (links_[i].entry->hooks.take_torque) effect.take_torque(torque_Nm, start);
    torque_Nm = shaped_Nm;
  }
  return torque_Nm_ = torque_Nm;
}

double EffectChain::torque_Nm(double torque_Nm, const TickStart& start) const noexcept FEEDTWIN_REALTIME {
  for (const std::size_t i : torque_) torque_Nm = links_[i].effect->torque_Nm(torque_Nm, start);
  return torque_Nm;
}

EffectMotion EffectChain::screw_motion(const AxisState<double>& state, const Sliding<double>& m,
                                       double torque_Nm) const noexcept {
  return {.position_m = state.position_m,
          .velocity_m_per_s = m.sign * m.speed_m_per_s,
          .sign = m.sign,
          .acceleration_m_per_s2 = state.acceleration_m_per_s2,
          .torque_Nm = torque_Nm,
          .table_load_N = 0.0,
          .h_s = m.h_s,
          .time_s = time_s_ + tick_phase_s_,
          .tick_phase_s = tick_phase_s_};
}

EffectMotion EffectChain::table_motion(const EffectMotion& screw) const noexcept {
  if (!coupling_) return screw;
  EffectMotion table = screw;
  table.position_m = coupling_->position_m();
  table.velocity_m_per_s = coupling_->predicted_velocity_m_per_s(screw.h_s);
  table.acceleration_m_per_s2 = coupling_->acceleration_m_per_s2();
  table.sign = table.velocity_m_per_s > 0.0 ? 1.0 : table.velocity_m_per_s < 0.0 ? -1.0 : screw.sign;
  return table;
}

FrictionScale<double> EffectChain::scale_at(EffectMotion screw, EffectMotion table, double table_load_N) const noexcept {
  FrictionScale<double> scale;
  screw.table_load_N = table.table_load_N = table_load_N;
  for (const std::size_t i : scaling_) links_[i].effect->scale(links_[i].at_table ? table : screw, scale);
  return {bounded(scale.screw_sliding), bounded(scale.screw_viscous), bounded(scale.guide_sliding),
          bounded(scale.guide_viscous)};
}

ExtraLoad<double> EffectChain::before(const AxisState<double>& start,
                                      const Sliding<double>& predicted) noexcept FEEDTWIN_REALTIME {
  screw_ = screw_motion(start, predicted, torque_Nm_);
  table_ = table_motion(screw_);
  EffectLoad on_screw;
  EffectLoad on_table;
  for (const std::size_t i : screw_loads_) {
    auto& load = links_[i].load = links_[i].effect->load(screw_);
    on_screw.force_N += load.force_N;
    on_screw.slope_Ns_per_m += load.slope_Ns_per_m;
  }
  for (const std::size_t i : table_loads_) {
    auto& load = links_[i].load = links_[i].effect->load(table_);
    on_table.force_N += load.force_N;
    on_table.slope_Ns_per_m += load.slope_Ns_per_m;
  }
  const FrictionScale<double> scale =
      scaling_.empty() ? FrictionScale<double>{} : scale_at(screw_, table_, on_table.force_N + cutting_force_N_);
  if (coupling_) {
    on_table.force_N += cutting_force_N_;
    on_table = coupling_->respond(screw_, start.velocity_m_per_s, on_table, scale);
  }
  return {on_screw.force_N + on_table.force_N, on_screw.slope_Ns_per_m + on_table.slope_Ns_per_m, scale};
}

void EffectChain::after(const AxisState<double>& /*end*/, double mean_velocity_m_per_s,
                        double h_s) noexcept FEEDTWIN_REALTIME {
  const double table_w = coupling_ ? coupling_->finish(mean_velocity_m_per_s) : mean_velocity_m_per_s;
  const auto account = [this, h_s](std::size_t i, double real, double predicted) {
    auto& link = links_[i];
    const double work_J = (link.load.force_N + link.load.slope_Ns_per_m * (real - predicted)) * real * h_s;
    link.work_J += work_J;
    if (link.entry->work == EffectWork::motor_torque) motor_torque_J_ += work_J;
    magnitude_J_ += std::abs(work_J);
  };
  for (const std::size_t i : screw_loads_) account(i, mean_velocity_m_per_s, screw_.velocity_m_per_s);
  for (const std::size_t i : table_loads_) account(i, table_w, table_.velocity_m_per_s);
  screw_.velocity_m_per_s = mean_velocity_m_per_s;
  table_.velocity_m_per_s = table_w;
  screw_.h_s = table_.h_s = h_s;
  for (const std::size_t i : advancing_) links_[i].effect->advance(links_[i].at_table ? table_ : screw_);
  tick_phase_s_ += h_s;
}

void EffectChain::sense(SensedTravel& travel) noexcept FEEDTWIN_REALTIME {
  for (const std::size_t i : sensing_) links_[i].effect->sense(travel);
}

std::int64_t EffectChain::counts(std::int64_t counts) noexcept FEEDTWIN_REALTIME {
  for (const std::size_t i : counting_) counts = links_[i].effect->counts(counts);
  return counts;
}

double EffectChain::power_W(TickPower power) noexcept FEEDTWIN_REALTIME {
  for (const std::size_t i : power_) power.power_W = links_[i].effect->power_W(power);
  return power.power_W;
}

void EffectChain::show(AxisSignals& signals) noexcept FEEDTWIN_REALTIME {
  for (const std::size_t i : showing_) links_[i].effect->show(signals);
}

void EffectChain::show_forces(ForceSignals& forces) const noexcept FEEDTWIN_REALTIME {
  for (const std::size_t i : showing_forces_) links_[i].effect->show_forces(forces);
}

void EffectChain::take_forces(const ForceSignals& forces) noexcept FEEDTWIN_REALTIME {
  ForceSignals shown = forces;  // each remembers what the ones before it show
  for (const std::size_t i : showing_forces_) {
    auto& link = links_[i];
    const ForceSignals before = shown;
    link.effect->show_forces(shown);
    if (link.entry->hooks.take_forces) link.effect->take_forces(before);
  }
}

EffectChain::Instant EffectChain::instant(const AxisState<double>& state, double torque_Nm,
                                          double cutting_force_N) const noexcept FEEDTWIN_REALTIME {
  constexpr double instant_s = 1e-9;
  const double v = state.velocity_m_per_s;
  const EffectMotion screw = screw_motion(state, {v < 0.0 ? -1.0 : 1.0, std::abs(v), instant_s, 1.0 / instant_s}, torque_Nm);
  const EffectMotion table = table_motion(screw);
  Instant now{};
  for (const std::size_t i : screw_loads_) {
    if (links_[i].entry->hooks.torque) continue;  // its torque is at the instant already
    const auto component = links_[i].entry->component;
    const bool on_motor = component == EffectComponent::motor || component == EffectComponent::drive;
    (on_motor ? now.motor_N : now.screw_N) += links_[i].effect->load(screw).force_N;
  }
  for (const std::size_t i : table_loads_) now.table_N += links_[i].effect->load(table).force_N;
  now.scale = scale_at(screw, table, now.table_N + cutting_force_N);
  return now;
}

EffectChain::Work EffectChain::work(const AxisState<double>& state) const noexcept {
  Work sum;
  sum.magnitude_J = magnitude_J_;
  for (const auto& link : links_) {
    const double stored_J = link.entry->work == EffectWork::conserves ? link.work_J : link.effect->stored_J();
    if (link.entry->work == EffectWork::motor_torque) continue;  // part of the input work
    switch (link.entry->component) {
      case EffectComponent::motor:
      case EffectComponent::drive:
        sum.motor_J += link.work_J;
        break;
      case EffectComponent::guide:
        sum.guide_J += link.work_J;
        break;
      case EffectComponent::load:
        sum.load_J += link.work_J;
        break;
      default:
        sum.screw_J += link.work_J;
    }
    sum.stored_J += stored_J;
    if (link.entry->work == EffectWork::dissipates || link.entry->work == EffectWork::alters_friction) {
      sum.lost_J += link.work_J - stored_J;
    }
  }
  if (coupling_) {
    sum.screw_J += coupling_->own_J();
    sum.stored_J += coupling_->spring_J(state.position_m);
    sum.lost_J += coupling_->own_J() - coupling_->spring_J(state.position_m);
  }
  return sum;
}

}  // namespace feedtwin::plant
