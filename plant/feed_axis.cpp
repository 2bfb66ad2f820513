#include "plant/feed_axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plant/force_sensors.h"

namespace feedtwin::plant {

namespace {

std::unique_ptr<EffectChain> chain_of(const AxisParameters& axis, const AxisModel<double>& model) {
  auto chain = axis.effects.empty() ? nullptr : std::make_unique<EffectChain>(axis, model);
  return chain == nullptr || chain->empty() ? nullptr : std::move(chain);
}

}  // namespace

FeedAxis::FeedAxis(const AxisParameters& parameters, Resolution resolution)
    : FeedAxis(parameters, adapted(parameters), resolution) {}

FeedAxis::FeedAxis(const AxisParameters& nominal, const AxisParameters& true_axis, Resolution resolution)
    : parameters_(nominal),
      model_(make_axis_model(true_axis)),
      chain_(chain_of(true_axis, model_)),
      driven_(chain_ ? chain_->driven(model_) : model_),
      resolution_(chain_ ? chain_->at_least(resolution) : resolution),
      calm_resolution_(chain_ ? chain_->at_least_in_a_calm_tick(resolution) : resolution),
      encoder_(nominal.axis.lead_m, nominal.axis.encoder_counts_per_rev),
      true_encoder_(true_axis.axis.lead_m, true_axis.axis.encoder_counts_per_rev),
      power_meter_(true_axis.power_meter_window_s, true_axis.power_meter_readings) {
  place(nominal.axis.stroke_centre_m);
}

void FeedAxis::place(double position_m, double velocity_m_per_s) noexcept {
  state_ = {};
  state_.position_m = position_m;
  state_.velocity_m_per_s = velocity_m_per_s;
  initial_speed_squared_m2_per_s2_ = velocity_m_per_s * velocity_m_per_s;
  throughput_J_ += 0.5 * model_.mass_kg * initial_speed_squared_m2_per_s2_;
  placed_s_ = elapsed_s_;
  law_friction_J_when_placed_ = law_friction_J();
  if (chain_) chain_->reset(position_m, velocity_m_per_s);
  if (chain_) {
    show_with_effects();
  } else {
    show({position_m, position_m}, true_encoder_.counts(position_m));
  }
  signals_.index_passed = false;
}

FeedAxis::Drive FeedAxis::accept(const AxisCommand& command) const noexcept {
  const auto within = [](double value, double limit) {
    return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0;
  };
  return {within(command.torque_Nm, parameters_.axis.torque_limit_Nm),
          within(command.cutting_force_N, largest_cutting_force_N), command.setpoint_m_per_s};
}

double FeedAxis::electrical_loss_J(const AxisLosses<double>& losses, double duration_s) const noexcept {
  const auto& motor = parameters_.motor;
  return motor.electrical_idle_W * duration_s + motor.electrical_linear_Ws_per_m.pos * losses.travel_pos_m +
         motor.electrical_linear_Ws_per_m.neg * losses.travel_neg_m +
         motor.electrical_quadratic_Ws2_per_m2.pos * losses.speed_travel_pos_m2_per_s +
         motor.electrical_quadratic_Ws2_per_m2.neg * losses.speed_travel_neg_m2_per_s;
}

TickStart FeedAxis::tick_start(const Drive& drive, double tick_s, double span_s) const noexcept {
  return {.time_s = elapsed_s_ - placed_s_,
          .tick_s = tick_s,
          .span_s = span_s,
          .state = state_,
          .setpoint_m_per_s = std::isfinite(drive.setpoint_m_per_s) ? drive.setpoint_m_per_s : state_.velocity_m_per_s,
          .law_friction_J = law_friction_J() - law_friction_J_when_placed_};
}

/// What a tick took, entered into the account. @return drive input, mean over the tick, W
inline double FeedAxis::account(const AxisLosses<double>& taken, double work_J, double cutting_J, double tick_s) noexcept {
  losses_ += taken;
  elapsed_s_ += tick_s;
  input_work_J_ += work_J;
  throughput_J_ += std::abs(work_J) + std::abs(cutting_J);
  cutting_J_ += cutting_J;
  return (electrical_loss_J(taken, tick_s) + work_J) / tick_s;
}

/// What moves and what the encoder and the power meter show of it.
inline void FeedAxis::show(const SensedTravel& travel, std::int64_t counts) noexcept {
  signals_.index_passed = encoder_.index_between(signals_.encoder_counts, counts);
  signals_.encoder_counts = counts;
  signals_.position_m = state_.position_m;
  signals_.scale_position_m = travel.scale_m;
  signals_.velocity_m_per_s = state_.velocity_m_per_s;
}

const AxisSignals& FeedAxis::step(const AxisCommand& command, double tick_s) noexcept FEEDTWIN_REALTIME {
  const Drive drive = accept(command);
  clipped_inputs_ += (drive.torque_Nm != command.torque_Nm) + (drive.cutting_force_N != command.cutting_force_N);
  if (chain_) return step_with_effects(drive, tick_s);

  NoEffects<double> none;
  const double motor_force_N = drive.torque_Nm * model_.transmission_rad_per_m;
  const double before_m = state_.position_m;
  const AxisLosses<double> taken =
      integrate_tick<double>(model_, state_, none, motor_force_N - drive.cutting_force_N, tick_s, resolution_);
  const double travel_m = state_.position_m - before_m;
  signals_.torque_Nm = drive.torque_Nm;
  signals_.power_W = account(taken, motor_force_N * travel_m, drive.cutting_force_N * travel_m, tick_s);
  signals_.metered_power_W = power_meter_.update(signals_.power_W, tick_s);
  show({state_.position_m, state_.position_m}, true_encoder_.counts(state_.position_m));
  return signals_;
}

/// Out of line, so that an axis without effects keeps its registers.
[[gnu::noinline]] const AxisSignals& FeedAxis::step_with_effects(const Drive& drive, double tick_s) noexcept {
  tick_s_ = tick_s;
  EffectChain& chain = *chain_;
  if (chain.remembers_forces()) chain.take_forces(true_forces(drive));
  const double rippled_J = chain.motor_torque_J();
  const double torque_Nm = chain.start_tick(drive.torque_Nm, drive.cutting_force_N, tick_start(drive, tick_s, tick_s));
  const double motor_force_N = torque_Nm * model_.transmission_rad_per_m;
  const double before_m = state_.position_m;
  const double table_before_m = table_position_m();
  const double on_screw_N = chain.has_table() ? 0.0 : drive.cutting_force_N;
  const double guide_J = chain.guide_J();
  const double stop_J = chain.stop_J();
  const Resolution& resolution = chain.calm(state_) ? calm_resolution_ : resolution_;
  auto taken = integrate_tick<double>(driven_, state_, chain, motor_force_N - on_screw_N, tick_s, resolution);
  taken.guide_J += chain.guide_J() - guide_J;
  taken.stop_J += chain.stop_J() - stop_J;

  const double work_J = motor_force_N * (state_.position_m - before_m) - (chain.motor_torque_J() - rippled_J);
  const double cutting_J = drive.cutting_force_N * (table_position_m() - table_before_m);
  const double power_W = account(taken, work_J, cutting_J, tick_s);
  signals_.torque_Nm = torque_Nm;
  signals_.power_W = chain.power_W({power_W, torque_Nm, tick_s});
  effect_power_J_ += (signals_.power_W - power_W) * tick_s;
  signals_.metered_power_W = power_meter_.update(signals_.power_W, tick_s);
  show_with_effects();
  return signals_;
}

void FeedAxis::show_with_effects() noexcept {
  SensedTravel travel{state_.position_m, table_position_m()};
  chain_->sense(travel);
  const std::int64_t seen = true_encoder_.counts(travel.shaft_m), counts = chain_->counts(seen);
  encoder_error_m_ = travel.shaft_m - state_.position_m + true_encoder_.position_m(counts - seen);
  show(travel, counts);
  chain_->show(signals_);
}

ForceSignals FeedAxis::force_sensors(const AxisCommand& acting) const noexcept FEEDTWIN_REALTIME {
  ForceSignals forces = true_forces(accept(acting));
  if (chain_) chain_->show_forces(forces);
  return forces;
}

ForceSignals FeedAxis::true_forces(const Drive& drive) const noexcept {
  constexpr double instant_s = 1e-9;
  double torque_Nm = drive.torque_Nm;
  EffectChain::Instant extra{};
  if (chain_) {
    torque_Nm = chain_->torque_Nm(torque_Nm, tick_start(drive, tick_s_, instant_s));
    extra = chain_->instant(state_, torque_Nm, drive.cutting_force_N);
  }
  const bool hanging = chain_ && chain_->has_table();
  const double v = state_.velocity_m_per_s;
  const auto friction = driven_.contacts.now(v, state_.screw_bristle_m, state_.guide_bristle_m, extra.scale);
  const double stop_N = end_stop_load<double>(driven_, state_.position_m, v, 0.0).force_N;
  const double on_table_N = hanging ? chain_->table().force_N(state_.position_m, v)
                                    : friction.guide_N + stop_N + extra.table_N + drive.cutting_force_N;
  const auto sensed = sensed_forces<double>(driven_, v, torque_Nm * driven_.transmission_rad_per_m - extra.motor_N,
                                            friction.screw_N + extra.screw_N, on_table_N);
  return {sensed.torque_sensor_Nm, sensed.force_sensor_N};
}

AxisEnergy FeedAxis::energy() const noexcept {
  const bool hanging = chain_ && chain_->has_table();
  const double v = state_.velocity_m_per_s;
  const double table_v = hanging ? chain_->table().velocity_m_per_s() : v;
  const double half_speed_squared = 0.5 * (v * v - initial_speed_squared_m2_per_s2_);
  const double table_half_speed_squared = 0.5 * (table_v * table_v - initial_speed_squared_m2_per_s2_);
  const double driven_mass_kg = model_.mass_kg - model_.table_mass_kg;
  const EffectChain::Work effects = chain_ ? chain_->work(state_) : EffectChain::Work{};
  const auto& stiffness = driven_.contacts.both.bristle.stiffness_N_per_m;
  const double bristles_J = 0.5 * (stiffness[0] * state_.screw_bristle_m * state_.screw_bristle_m +
                                   stiffness[1] * state_.guide_bristle_m * state_.guide_bristle_m) +
                            (hanging ? chain_->table().bristle_J() : 0.0);
  AxisEnergy energy;
  energy.motor_electrical_J = electrical_loss_J(losses_, elapsed_s_) + effect_power_J_;
  energy.motor_mechanical_J = losses_.motor_J + model_.motor_mass_kg * half_speed_squared + effects.motor_J;
  energy.ball_screw_J = losses_.screw_J + model_.screw_mass_kg * half_speed_squared + effects.screw_J;
  energy.guide_J = losses_.guide_J + model_.table_mass_kg * table_half_speed_squared + effects.guide_J;
  energy.cutting_J = cutting_J_;
  energy.end_stop_J = losses_.stop_J;
  energy.load_J = effects.load_J;
  energy.input_work_J = input_work_J_;
  energy.throughput_J = throughput_J_ + effects.magnitude_J;
  energy.kinetic_J = driven_mass_kg * half_speed_squared + model_.table_mass_kg * table_half_speed_squared;
  energy.stored_J = bristles_J + effects.stored_J;
  energy.lost_J = losses_.motor_J + losses_.screw_J + losses_.guide_J - bristles_J + effects.lost_J;
  return energy;
}

}  // namespace feedtwin::plant
