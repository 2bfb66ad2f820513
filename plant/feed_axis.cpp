#include "plant/feed_axis.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::plant {

FeedAxis::FeedAxis(const AxisParameters& parameters, Resolution resolution)
    : parameters_(parameters),
      model_(make_axis_model(parameters)),
      resolution_(resolution),
      encoder_(parameters.axis.lead_m, parameters.axis.encoder_counts_per_rev),
      power_meter_(parameters.power_meter_window_s) {
  place(parameters.axis.stroke_centre_m);
}

void FeedAxis::place(double position_m, double velocity_m_per_s) noexcept {
  state_ = {};
  state_.position_m = position_m;
  state_.velocity_m_per_s = velocity_m_per_s;
  signals_.position_m = position_m;
  signals_.scale_position_m = position_m;
  signals_.velocity_m_per_s = velocity_m_per_s;
  signals_.encoder_counts = encoder_.counts(position_m);
  initial_speed_squared_m2_per_s2_ = velocity_m_per_s * velocity_m_per_s;
  throughput_J_ += 0.5 * model_.mass_kg * initial_speed_squared_m2_per_s2_;
}

FeedAxis::Drive FeedAxis::accept(const AxisCommand& command) const noexcept {
  const auto within = [](double value, double limit) {
    return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0;
  };
  return {within(command.torque_Nm, parameters_.axis.torque_limit_Nm),
          within(command.cutting_force_N, largest_cutting_force_N)};
}

double FeedAxis::electrical_loss_J(const AxisLosses<double>& losses, double duration_s) const noexcept {
  const auto& motor = parameters_.motor;
  return motor.electrical_idle_W * duration_s + motor.electrical_linear_Ws_per_m.pos * losses.travel_pos_m +
         motor.electrical_linear_Ws_per_m.neg * losses.travel_neg_m +
         motor.electrical_quadratic_Ws2_per_m2.pos * losses.speed_travel_pos_m2_per_s +
         motor.electrical_quadratic_Ws2_per_m2.neg * losses.speed_travel_neg_m2_per_s;
}

const AxisSignals& FeedAxis::step(const AxisCommand& command, double tick_s) noexcept {
  const Drive drive = accept(command);
  clipped_inputs_ += (drive.torque_Nm != command.torque_Nm) + (drive.cutting_force_N != command.cutting_force_N);
  const double motor_force_N = drive.torque_Nm * model_.transmission_rad_per_m;
  const double before_m = state_.position_m;
  const AxisLosses<double> taken =
      integrate_tick<double>(model_, state_, effects_, motor_force_N - drive.cutting_force_N, tick_s, resolution_);
  losses_ += taken;
  elapsed_s_ += tick_s;
  const double travel_m = state_.position_m - before_m;
  const double work_J = motor_force_N * travel_m;
  input_work_J_ += work_J;
  throughput_J_ += std::abs(work_J) + std::abs(drive.cutting_force_N * travel_m);
  cutting_J_ += drive.cutting_force_N * travel_m;

  const std::int64_t counts = encoder_.counts(state_.position_m);
  signals_.index_passed = encoder_.index_between(signals_.encoder_counts, counts);
  signals_.encoder_counts = counts;
  signals_.position_m = state_.position_m;
  signals_.scale_position_m = state_.position_m;
  signals_.velocity_m_per_s = state_.velocity_m_per_s;
  signals_.torque_Nm = drive.torque_Nm;
  signals_.power_W = (electrical_loss_J(taken, tick_s) + work_J) / tick_s;
  signals_.metered_power_W = power_meter_.update(signals_.power_W, tick_s);
  return signals_;
}

ForceSignals FeedAxis::force_sensors(const AxisCommand& acting) const noexcept {
  const Drive drive = accept(acting);
  const double drive_N = drive.torque_Nm * model_.transmission_rad_per_m - drive.cutting_force_N;
  const double v = state_.velocity_m_per_s;
  const bool positive = v > 0.0;
  const auto& both = model_.contacts.both;
  const Doubles<2> friction = lugre_force_N<Doubles<2>>(both.bristle, positive ? both.pos : both.neg, Doubles<2>{} + v,
                                                        Doubles<2>{state_.screw_bristle_m, state_.guide_bristle_m});
  const double stop_N = end_stop_load<double>(model_, state_.position_m, v, 0.0).force_N;
  double acceleration = 0.0;  // at rest the motor's Coulomb friction holds
  if (v != 0.0) {
    const double coulomb = positive ? model_.coulomb_pos_N : -model_.coulomb_neg_N;
    const double damping = positive ? model_.damping_pos_Ns_per_m : model_.damping_neg_Ns_per_m;
    acceleration = (drive_N - coulomb - damping * v - friction[0] - friction[1] - stop_N) / model_.mass_kg;
  }
  const double table_N = model_.table_mass_kg * acceleration + friction[1] + stop_N + drive.cutting_force_N;
  const double screw_N = model_.screw_mass_kg * acceleration + friction[0] + table_N;
  return {screw_N / model_.transmission_rad_per_m, table_N};
}

AxisEnergy FeedAxis::energy() const noexcept {
  const double half_speed_squared =
      0.5 * (state_.velocity_m_per_s * state_.velocity_m_per_s - initial_speed_squared_m2_per_s2_);
  const auto& stiffness = model_.contacts.both.bristle.stiffness_N_per_m;
  const double stored_J = 0.5 * (stiffness[0] * state_.screw_bristle_m * state_.screw_bristle_m +
                                 stiffness[1] * state_.guide_bristle_m * state_.guide_bristle_m);
  AxisEnergy energy;
  energy.motor_electrical_J = electrical_loss_J(losses_, elapsed_s_);
  energy.motor_mechanical_J = losses_.motor_J + model_.motor_mass_kg * half_speed_squared;
  energy.ball_screw_J = losses_.screw_J + model_.screw_mass_kg * half_speed_squared;
  energy.guide_J = losses_.guide_J + model_.table_mass_kg * half_speed_squared;
  energy.cutting_J = cutting_J_;
  energy.end_stop_J = losses_.stop_J;
  energy.input_work_J = input_work_J_;
  energy.throughput_J = throughput_J_;
  energy.kinetic_J = model_.mass_kg * half_speed_squared;
  energy.stored_J = stored_J;
  energy.lost_J = losses_.motor_J + losses_.screw_J + losses_.guide_J - stored_J;
  return energy;
}

}  // namespace feedtwin::plant
