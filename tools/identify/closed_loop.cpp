#include "tools/identify/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "plant/axis_model.h"
#include "plant/effects/registry.h"
#include "tools/identify/sliding.h"

namespace feedtwin::tools {
namespace {

/// Speed at the first row: the slope there of the parabola through three rows, so that an axis that sets off from rest is at
/// rest. So is one that has not moved in the second row, or whose parabola would have to come from the other side: it sets
/// off later. 0 too where the slope is within what the encoder's rounding of the three can make of it.
double start_velocity(std::span<const double> position_m, const plant::AxisParameters& nominal, double tick_s) {
  const double count_m = nominal.axis.lead_m / nominal.axis.encoder_counts_per_rev;
  const double first_m = position_m[1] - position_m[0];
  const double slope_m = 0.5 * (4.0 * first_m - (position_m[2] - position_m[0]));
  const bool moves = std::abs(first_m) > 1.5 * count_m && std::abs(slope_m) > 2.0 * count_m;
  return moves && slope_m * first_m > 0.0 ? slope_m / tick_s : 0.0;
}

using Terms = ElectricalTerms::Terms;

Terms terms_at(double v) {
  return v > 0.0 ? Terms{v, 0.0, v * v, 0.0} : Terms{0.0, -v, 0.0, v * v};
}

Terms mean_terms(const plant::AxisLosses<double>& before, const plant::AxisLosses<double>& after, double tick_s) {
  return {(after.travel_pos_m - before.travel_pos_m) / tick_s, (after.travel_neg_m - before.travel_neg_m) / tick_s,
          (after.speed_travel_pos_m2_per_s - before.speed_travel_pos_m2_per_s) / tick_s,
          (after.speed_travel_neg_m2_per_s - before.speed_travel_neg_m2_per_s) / tick_s};
}

Terms coefficients_of(const plant::MotorParameters& motor) {
  const auto& linear = motor.electrical_linear_Ws_per_m;
  const auto& quadratic = motor.electrical_quadratic_Ws2_per_m2;
  return {linear.pos, linear.neg, quadratic.pos, quadratic.neg};
}

double product(const Terms& coefficients, const Terms& terms) {
  return std::inner_product(coefficients.begin(), coefficients.end(), terms.begin(), 0.0);
}

/// Where the encoder, with all that is wrong with it, shows the position.
void place_as_shown(plant::FeedAxis& axis, double shown_m, double velocity_m_per_s) {
  double true_m = shown_m;
  for (int i = 0; i < 3; ++i) {
    axis.place(true_m, velocity_m_per_s);
    true_m -= axis.shown_position_m() - shown_m;
  }
  axis.place(true_m, velocity_m_per_s);
}

}  // namespace

std::vector<controllers::Reference> with_derivatives(std::span<const double> position_m, double tick_s) {
  std::vector<controllers::Reference> all(position_m.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t middle = std::clamp<std::size_t>(i, 1, all.size() - 2);
    const double before = position_m[middle - 1], now = position_m[middle], after = position_m[middle + 1];
    const double acceleration = (after - 2.0 * now + before) / (tick_s * tick_s);
    const double off_s = (static_cast<double>(i) - static_cast<double>(middle)) * tick_s;
    all[i] = {position_m[i], (after - before) / (2.0 * tick_s) + acceleration * off_s, acceleration};
  }
  return all;
}

plant::AxisParameters without_stops(plant::AxisParameters parameters) {
  parameters.axis.end_stop_stiffness_N_per_m = 0.0;  // the stroke itself stays: friction may vary along it
  parameters.axis.end_stop_damping_Ns_per_m = 0.0;
  return parameters;
}

ClosedLoopRun::ClosedLoopRun(const Recording& recording, const plant::AxisParameters& nominal,
                             const std::optional<controllers::CascadeGains>& controller, const StandInSettings& stand_in)
    : recording_(&recording),
      setpoints_(setpoints_of(recording, nominal.axis.lead_m / nominal.axis.encoder_counts_per_rev)),
      motor_slides_(rows_of_surely_sliding(recording.at(channel::position_m), recording.sample_s)),
      view_{},
      nominal_(nominal) {
  const auto position_m = recording.at(channel::position_m);
  if (controller) reference_ = with_derivatives(recording.at(channel::reference_m), recording.sample_s);
  view_ = {.samples = recording.size(),
           .tick_s = recording.sample_s,
           .torque_Nm = recording.at(channel::torque_cmd_Nm).data(),
           .position_m = position_m.data(),
           .reference = nullptr,
           .gains = controller.value_or(controllers::CascadeGains{}),
           .stand_in = stand_in,
           .stand_in_mass_kg = plant::make_axis_model(nominal).mass_kg,
           .torque_limit_Nm = nominal.axis.torque_limit_Nm,
           .start_velocity_m_per_s = start_velocity(position_m, nominal, recording.sample_s)};
}

lanes::RecordView ClosedLoopRun::view() const noexcept {
  lanes::RecordView view = view_;
  view.reference = reference_.empty() ? nullptr : reference_.data();
  return view;
}

Simulated simulate_closed_loop(const ClosedLoopRun& run, plant::FeedAxis& axis, double position_offset_m, bool sensors,
                               ElectricalTerms* terms) {
  const auto view = run.view();
  const double transmission = axis.model().transmission_rad_per_m;
  place_as_shown(axis, view.position_m[0], view.start_velocity_m_per_s);
  StandIn<double> stand_in(view.stand_in, view.stand_in_mass_kg, view.tick_s);
  controllers::CascadeLaw<double> cascade(view.gains);
  cascade.reset(view.position_m[0] - position_offset_m);
  Simulated out;
  for (auto* channel : {&out.torque_Nm, &out.position_m, &out.power_W, &out.scale_position_m, &out.instant_power_W})
    channel->resize(view.samples);
  for (auto* channel : {&out.torque_sensor_Nm, &out.force_sensor_N}) channel->resize(sensors ? view.samples : 0);
  const Terms coefficients = coefficients_of(axis.parameters().motor);
  const bool of_command = run.recording().meter.of_command;
  const bool before_command = run.recording().forces_before_command;
  plant::AxisCommand acting{.torque_Nm = view.torque_Nm[0]};
  const SetpointSource source = setpoint_source(axis.parameters());
  const Setpoint& setpoint = run.setpoints().by(source.of_motion);
  for (std::size_t i = 0; i < view.samples; ++i) {
    const double shown_m = axis.shown_position_m() - position_offset_m;
    out.position_m[i] = shown_m;
    out.scale_position_m[i] = axis.signals().scale_position_m - position_offset_m;
    out.torque_Nm[i] = view.reference != nullptr
                           ? cascade.torque_Nm(view.reference[i], shown_m, view.tick_s)
                           : view.torque_Nm[i] + stand_in.correction_N(view.position_m[i] - shown_m) / transmission;
    const plant::AxisCommand command{.torque_Nm = out.torque_Nm[i], .setpoint_m_per_s = setpoint.m_per_s(i, source.lead_s)};
    if (sensors) {
      const auto forces = axis.force_sensors(before_command ? acting : command);
      acting = command;
      out.torque_sensor_Nm[i] = forces.torque_sensor_Nm;
      out.force_sensor_N[i] = forces.force_sensor_N;
    }
    const double start_m = axis.signals().position_m, start_m_per_s = axis.signals().velocity_m_per_s;
    const auto before = terms != nullptr ? axis.losses() : plant::AxisLosses<double>{};
    const double worked_J = axis.input_work_J();
    const auto& after = axis.step(command, view.tick_s);
    out.power_W[i] = after.power_W;
    double force_N = after.torque_Nm * transmission;
    const double mean_m_per_s = (after.position_m - start_m) / view.tick_s;
    if (of_command) {
      force_N = command.torque_Nm * transmission;
      out.power_W[i] += force_N * mean_m_per_s - (axis.input_work_J() - worked_J) / view.tick_s;
    }
    const Terms at_start = terms_at(start_m_per_s), at_mean = terms_at(mean_m_per_s);
    out.instant_power_W[i] = out.power_W[i] + (product(coefficients, at_start) + force_N * start_m_per_s) -
                             (product(coefficients, at_mean) + force_N * mean_m_per_s);
    if (terms == nullptr) continue;
    Terms& mean = terms->mean.emplace_back(mean_terms(before, axis.losses(), view.tick_s));
    Terms& instant = terms->at_instant.emplace_back(mean);
    for (std::size_t k = 0; k < instant.size(); ++k) instant[k] += at_start[k] - at_mean[k];
  }
  return out;
}

plant::AxisParameters without_electrical(plant::AxisParameters parameters) {
  const auto shapes_power = [](const plant::EffectSetting& e) { return plant::find_effect(e.id)->hooks.power; };
  if (std::ranges::any_of(parameters.effects, shapes_power)) return parameters;
  parameters.motor.electrical_idle_W = 0.0;
  parameters.motor.electrical_linear_Ws_per_m = parameters.motor.electrical_quadratic_Ws2_per_m2 = {};
  return parameters;
}

Simulated with_electrical(Simulated simulated, const ElectricalTerms& terms, const plant::MotorParameters& from,
                          const plant::MotorParameters& to) {
  const double idle_W = to.electrical_idle_W - from.electrical_idle_W;
  Terms more = coefficients_of(to);
  const Terms less = coefficients_of(from);
  for (std::size_t k = 0; k < more.size(); ++k) more[k] -= less[k];
  for (std::size_t i = 0; i < terms.mean.size(); ++i) {
    simulated.power_W[i] += idle_W + product(more, terms.mean[i]);
    simulated.instant_power_W[i] += idle_W + product(more, terms.at_instant[i]);
  }
  return simulated;
}

std::vector<Simulated> simulate_closed_loop(const ClosedLoopRun& run, std::span<const CandidateAxis> candidates,
                                            const lanes::Wanted& wanted, unsigned threads) {
  std::vector<lanes::Candidate> models;
  models.reserve(candidates.size());
  for (const auto& [parameters, position_offset_m, force_offset_N, start_offset_m] : candidates) {
    const auto& motor = parameters.motor;
    models.push_back({plant::make_axis_model(without_stops(parameters)), motor.electrical_idle_W,
                      motor.electrical_linear_Ws_per_m.pos, motor.electrical_linear_Ws_per_m.neg,
                      motor.electrical_quadratic_Ws2_per_m2.pos, motor.electrical_quadratic_Ws2_per_m2.neg,
                      position_offset_m, force_offset_N, start_offset_m});
  }
  return lanes::simulate_candidates(run.view(), models, wanted, threads);
}

}  // namespace feedtwin::tools
