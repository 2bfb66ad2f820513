#pragma once
// One feed axis: motor, ball screw, linear guide and table, its sensors and its energy account.

#include <cstdint>

#include "plant/axis_model.h"
#include "plant/encoder.h"
#include "plant/energy.h"
#include "plant/integrator.h"
#include "plant/parameters.h"
#include "plant/power_meter.h"
#include "plant/signals.h"

namespace feedtwin::plant {

/// Largest magnitudes taken from outside; beyond them an input is clipped and counted.
inline constexpr double largest_cutting_force_N = 1e6;

class FeedAxis {
 public:
  explicit FeedAxis(const AxisParameters& parameters, Resolution resolution = one_count);

  /// Advance by one tick; the command is held for its length. Non-finite input counts as zero, input beyond the limits is
  /// clipped; both are counted. Wait-free; at most Resolution's sub-steps + extra_substeps evaluations.
  const AxisSignals& step(const AxisCommand& command, double tick_s) noexcept;

  [[nodiscard]] const AxisSignals& signals() const noexcept { return signals_; }
  [[nodiscard]] const AxisState<double>& state() const noexcept { return state_; }
  [[nodiscard]] const AxisModel<double>& model() const noexcept { return model_; }
  [[nodiscard]] const AxisParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const Encoder& encoder() const noexcept { return encoder_; }
  /// Torque and force sensor at this instant with `acting` as the command, as a recording samples them at the start of a
  /// tick. Costs a third of a step, so only where it is asked for. Wait-free.
  [[nodiscard]] ForceSignals force_sensors(const AxisCommand& acting) const noexcept;
  [[nodiscard]] AxisEnergy energy() const noexcept;
  [[nodiscard]] std::int64_t clipped_inputs() const noexcept { return clipped_inputs_; }

  /// Put the axis somewhere, at the given velocity, bristles relaxed. Set-up only.
  void place(double position_m, double velocity_m_per_s = 0.0) noexcept;

 private:
  struct Drive {
    double torque_Nm, cutting_force_N;
  };
  [[nodiscard]] Drive accept(const AxisCommand& command) const noexcept;
  [[nodiscard]] double electrical_loss_J(const AxisLosses<double>& losses, double duration_s) const noexcept;

  AxisParameters parameters_;
  AxisModel<double> model_;
  Resolution resolution_;
  AxisState<double> state_;
  AxisLosses<double> losses_;
  NoEffects<double> effects_;
  Encoder encoder_;
  PowerMeter power_meter_;
  AxisSignals signals_;
  double elapsed_s_ = 0.0;
  double input_work_J_ = 0.0;
  double throughput_J_ = 0.0;
  double cutting_J_ = 0.0;
  double initial_speed_squared_m2_per_s2_ = 0.0;
  std::int64_t clipped_inputs_ = 0;
};

}  // namespace feedtwin::plant
