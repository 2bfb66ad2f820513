#pragma once
// One feed axis: motor, ball screw, linear guide and table, its sensors and its energy account.

#include <cstdint>
#include <memory>

#include "plant/axis_model.h"
#include "plant/effects/chain.h"
#include "plant/encoder.h"
#include "plant/energy.h"
#include "plant/integrator.h"
#include "plant/parameters.h"
#include "plant/power_meter.h"
#include "plant/realtime.h"
#include "plant/signals.h"

namespace feedtwin::plant {

/// Largest magnitudes taken from outside; beyond them an input is clipped and counted.
inline constexpr double largest_cutting_force_N = 1e6;

class FeedAxis {
 public:
  /// Throws std::invalid_argument when an effect of the parameters is unknown or its setting does not fit.
  explicit FeedAxis(const AxisParameters& parameters, Resolution resolution = one_count);

  /// Advance by one tick; the command is held for its length. Non-finite input counts as zero, input beyond the limits is
  /// clipped; both are counted. Wait-free; at most Resolution's sub-steps + extra_substeps evaluations. Effects may ask
  /// for more sub-steps (EffectChain::at_least).
  const AxisSignals& step(const AxisCommand& command, double tick_s) noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] const AxisSignals& signals() const noexcept { return signals_; }
  [[nodiscard]] const AxisState<double>& state() const noexcept { return state_; }
  [[nodiscard]] const AxisModel<double>& model() const noexcept { return model_; }
  [[nodiscard]] const AxisParameters& parameters() const noexcept { return parameters_; }
  /// As the configuration has it.
  [[nodiscard]] const Encoder& encoder() const noexcept { return encoder_; }
  /// Where the table is: apart from state() only where an effect puts a gap or a spring between screw and table.
  [[nodiscard]] double table_position_m() const noexcept {
    return chain_ ? chain_->table_position_m(state_) : state_.position_m;
  }
  /// What the encoder shows as table travel, before it counts: the shaft's angle with what effects make of it.
  [[nodiscard]] double shown_position_m() const noexcept {
    return (signals_.position_m + encoder_error_m_) * (encoder_.resolution_m() / true_encoder_.resolution_m());
  }
  /// Torque and force sensor at this instant with `acting` as the command, as a recording samples them at the start of a
  /// tick. Costs a third of a step, so only where it is asked for. Wait-free.
  [[nodiscard]] ForceSignals force_sensors(const AxisCommand& acting) const noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] AxisEnergy energy() const noexcept FEEDTWIN_REALTIME;
  /// Work of the motor's torque so far.
  [[nodiscard]] double input_work_J() const noexcept { return input_work_J_; }
  /// Summed up since the axis was made.
  [[nodiscard]] const AxisLosses<double>& losses() const noexcept { return losses_; }
  [[nodiscard]] std::int64_t clipped_inputs() const noexcept { return clipped_inputs_; }

  /// Put the axis somewhere, at the given velocity, bristles relaxed. Set-up only.
  void place(double position_m, double velocity_m_per_s = 0.0) noexcept;

 private:
  FeedAxis(const AxisParameters& nominal, const AxisParameters& true_axis, Resolution resolution);

  struct Drive {
    double torque_Nm, cutting_force_N, setpoint_m_per_s;
  };
  [[nodiscard]] Drive accept(const AxisCommand& command) const noexcept;
  [[nodiscard]] TickStart tick_start(const Drive& drive, double tick_s, double span_s) const noexcept;
  const AxisSignals& step_with_effects(const Drive& drive, double tick_s) noexcept;
  double account(const AxisLosses<double>& taken, double work_J, double cutting_J, double tick_s) noexcept;
  void show(const SensedTravel& travel, std::int64_t counts) noexcept;
  void show_with_effects() noexcept;
  [[nodiscard]] ForceSignals true_forces(const Drive& drive) const noexcept;
  [[nodiscard]] double law_friction_J() const noexcept {
    return parameters_.laws_on_guide() ? losses_.guide_J : losses_.screw_J;
  }
  [[nodiscard]] double electrical_loss_J(const AxisLosses<double>& losses, double duration_s) const noexcept;

  AxisParameters parameters_;
  AxisModel<double> model_;
  std::unique_ptr<EffectChain> chain_;  ///< none where no effect runs in the tick
  AxisModel<double> driven_;            ///< what the integrator moves: the model, less what effects stand for
  Resolution resolution_, calm_resolution_;
  AxisState<double> state_;
  AxisLosses<double> losses_;
  Encoder encoder_;       ///< as the configuration has it
  Encoder true_encoder_;  ///< as the screw turns it (wrong_lead)
  PowerMeter power_meter_;
  AxisSignals signals_;
  double encoder_error_m_ = 0.0;  ///< shown less true shaft angle, as table travel
  double tick_s_ = 1e-3;          ///< of the last step
  double elapsed_s_ = 0.0;
  double placed_s_ = 0.0, law_friction_J_when_placed_ = 0.0;  ///< where effects begin to count
  double input_work_J_ = 0.0;
  double throughput_J_ = 0.0;
  double cutting_J_ = 0.0;
  double effect_power_J_ = 0.0;  ///< drive input that effects add
  double initial_speed_squared_m2_per_s2_ = 0.0;
  std::int64_t clipped_inputs_ = 0;
};

}  // namespace feedtwin::plant
