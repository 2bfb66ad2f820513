#pragma once
// Forward simulation of a recorded run in closed loop: the case's controller, or a stand-in, commands the plant that the
// server runs; the torque command is the output that tells, because position in closed loop barely moves.
//
// Conventions of a recording's row k, at t = k T: positions, torque and force sensor are of that instant, the sensors with
// command k acting; command k is held until row k + 1; the power meter is read at the end of that tick.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "controllers/reference.h"
#include "plant/feed_axis.h"
#include "tools/identify/lanes/dispatch.h"
#include "tools/identify/setpoint.h"
#include "tools/recording/case.h"
#include "tools/recording/power_meter.h"

namespace feedtwin::tools {

/// Position with its derivatives, as an interpolator would have them: from the parabola through a row and its neighbours.
[[nodiscard]] std::vector<controllers::Reference> with_derivatives(std::span<const double> position_m, double tick_s);

/// A recording made ready for closed-loop simulation. Refers to the recording, which must outlive it.
class ClosedLoopRun {
 public:
  ClosedLoopRun(const Recording& recording, const plant::AxisParameters& nominal,
                const std::optional<controllers::CascadeGains>& controller, const StandInSettings& stand_in = {});

  [[nodiscard]] const Recording& recording() const noexcept { return *recording_; }
  /// For the kernels; valid as long as this object stays where it is.
  [[nodiscard]] lanes::RecordView view() const noexcept;
  [[nodiscard]] const plant::AxisParameters& nominal() const noexcept { return nominal_; }
  [[nodiscard]] bool has_controller() const noexcept { return !reference_.empty(); }
  /// What the drive was told to reach.
  [[nodiscard]] const Setpoints& setpoints() const noexcept { return setpoints_; }
  /// Row by row: has the motor's Coulomb friction fully set in? Asked by what reads a torque sensor.
  [[nodiscard]] const std::vector<bool>& motor_slides() const noexcept { return motor_slides_; }

 private:
  const Recording* recording_;
  std::vector<controllers::Reference> reference_;
  Setpoints setpoints_;
  std::vector<bool> motor_slides_;
  lanes::RecordView view_;
  plant::AxisParameters nominal_;
};

/// Channels as simulated, each as long as the run; `torque_Nm` is what the controller asks for.
using Simulated = lanes::CandidateResult;

/// The same axis without its end stops: where they stand is not what a recording of motion is about.
[[nodiscard]] plant::AxisParameters without_stops(plant::AxisParameters parameters);

/// What the coefficients of Eq. 7 multiply, tick by tick: speed forth and back, its square forth and back.
struct ElectricalTerms {
  using Terms = std::array<double, 4>;
  std::vector<Terms> mean, at_instant;  ///< as power_W and instant_power_W are
};

/// Any axis, with whatever effects it has, one at a time. The axis is placed at the run's start first.
/// @param sensors whether torque and force sensor are wanted too: they cost a quarter more; empty otherwise
/// @param terms takes what other electrical coefficients would need; nullptr: nobody asks
[[nodiscard]] Simulated simulate_closed_loop(const ClosedLoopRun& run, plant::FeedAxis& axis, double position_offset_m = 0.0,
                                             bool sensors = true, ElectricalTerms* terms = nullptr);

/// The same axis without Eq. 7's losses: axes that are alike so differ in the coefficients at most. Where an effect shapes
/// the power it is not linear in them, and they stay.
[[nodiscard]] plant::AxisParameters without_electrical(plant::AxisParameters parameters);
/// The same motion under other electrical coefficients.
[[nodiscard]] Simulated with_electrical(Simulated simulated, const ElectricalTerms& terms,
                                        const plant::MotorParameters& from, const plant::MotorParameters& to);

/// Many parameter sets of the paper's model at once (lanes/dispatch.h).
struct CandidateAxis {
  plant::AxisParameters parameters;
  double position_offset_m = 0.0;  ///< simulated less shown position; an encoder that rounds down has half a count
  double force_offset_N = 0.0;     ///< constant, against positive motion
  double start_offset_m = 0.0;     ///< where this run starts, less where its first row says: anywhere within a count
};
[[nodiscard]] std::vector<Simulated> simulate_closed_loop(const ClosedLoopRun& run,
                                                          std::span<const CandidateAxis> candidates,
                                                          const lanes::Wanted& wanted, unsigned threads = 0);

}  // namespace feedtwin::tools
