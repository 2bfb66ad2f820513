#pragma once
// What an effect is: physics that Eq. 1 leaves out, as a component that runs inside the tick.
//
// An effect overrides the hooks that its law needs and no others; the chain (plant/effects/chain.h) calls only those.
// Forces follow Eq. 1's right-hand side: positive acts against positive motion of the table. All hooks are wait-free.

#include "plant/axis_model.h"
#include "plant/contacts.h"
#include "plant/effects/setting.h"
#include "plant/realtime.h"
#include "plant/signals.h"

namespace feedtwin::plant {

/// What an effect is made from.
struct EffectContext {
  const AxisParameters& axis;
  const AxisModel<double>& model;
};

/// The axis at the start of a tick.
struct TickStart {
  double time_s;  ///< since the axis was placed
  double tick_s;
  double span_s;  ///< over what a torque is averaged: the tick, or next to nothing for the torque at its start
  const AxisState<double>& state;
  double setpoint_m_per_s;  ///< velocity that the drive is told to reach; the axis's own where it is told none
  double law_friction_J;    ///< work on the friction of the contact that laws change, since the axis was placed
};

/// A sub-step as the effect's side of the transmission sees it (screw or table; the same without compliance).
struct EffectMotion {
  double position_m;        ///< at the start of the sub-step
  double velocity_m_per_s;  ///< mean over it: predicted in load() and scale(), real in advance()
  double sign;              ///< direction of motion, +1 or -1; at rest the direction that is tried
  double acceleration_m_per_s2;
  double torque_Nm;     ///< the motor's, mean over the tick
  double table_load_N;  ///< in scale() alone: all on the table but its inertia and the guide's friction
  double h_s;
  double time_s;        ///< since the axis was placed, at the start of the sub-step
  double tick_phase_s;  ///< since the start of the tick
};

/// Mean force of a sub-step and its slope by the mean velocity.
struct EffectLoad {
  double force_N = 0.0;  ///< against positive motion
  double slope_Ns_per_m = 0.0;
};

/// What the sensors see before they count.
struct SensedTravel {
  double shaft_m;  ///< the motor shaft's angle as table travel
  double scale_m;  ///< what the linear scale at the table shows
};

/// A tick's drive input power and what it depends on.
struct TickPower {
  double power_W;
  double torque_Nm;  ///< the motor's, mean over the tick
  double tick_s;
};

/// The spring between screw and table, with play.
struct CouplingParameters {
  double gap_m = 0.0;
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
};

class Effect {
 public:
  Effect() = default;
  Effect(const Effect&) = delete;
  Effect& operator=(const Effect&) = delete;
  virtual ~Effect() = default;

  /// Set-up: back to the start of a run.
  virtual void reset(double /*position_m*/) noexcept {}
  /// Set-up: a share in the coupling between screw and table.
  virtual void join(CouplingParameters& /*coupling*/) const noexcept {}
  /// Set-up: does its force stand for the motor's Coulomb friction, so that the integrator has none of its own?
  [[nodiscard]] virtual bool is_motor_friction() const noexcept { return false; }

  /// Once at the start of a tick.
  virtual void tick(const TickStart& /*start*/) noexcept FEEDTWIN_REALTIME {}
  /// Torque that this stage makes of what the stage before hands over from now on, mean over the start's span.
  [[nodiscard]] virtual double torque_Nm(double torque_Nm, const TickStart& /*start*/) const noexcept FEEDTWIN_REALTIME {
    return torque_Nm;
  }
  /// The tick runs with this torque handed over: for stages that remember.
  virtual void take_torque(double /*torque_Nm*/, const TickStart& /*start*/) noexcept FEEDTWIN_REALTIME {}
  /// Mean force over a sub-step; may be asked several times a sub-step.
  [[nodiscard]] virtual EffectLoad load(const EffectMotion& /*motion*/) const noexcept FEEDTWIN_REALTIME { return {}; }
  /// Changes friction over a sub-step; may be asked several times a sub-step.
  virtual void scale(const EffectMotion& /*motion*/, FrictionScale<double>& /*scale*/) const noexcept FEEDTWIN_REALTIME {}
  /// A sub-step is over.
  virtual void advance(const EffectMotion& /*motion*/) noexcept FEEDTWIN_REALTIME {}
  /// Geometry and sensors, once at the end of a tick.
  virtual void sense(SensedTravel& /*travel*/) noexcept FEEDTWIN_REALTIME {}
  [[nodiscard]] virtual std::int64_t counts(std::int64_t counts) noexcept FEEDTWIN_REALTIME { return counts; }
  /// Drive input power, mean over the tick.
  [[nodiscard]] virtual double power_W(const TickPower& power) noexcept FEEDTWIN_REALTIME { return power.power_W; }
  /// Signals as they are shown, last thing in a tick.
  virtual void show(AxisSignals& /*signals*/) noexcept FEEDTWIN_REALTIME {}
  /// Forces as they are shown, and for sensors that remember: the true ones at the start of each tick.
  virtual void show_forces(ForceSignals& /*forces*/) const noexcept FEEDTWIN_REALTIME {}
  virtual void take_forces(const ForceSignals& /*forces*/) noexcept FEEDTWIN_REALTIME {}
  /// Energy that the effect holds and can give back.
  [[nodiscard]] virtual double stored_J() const noexcept FEEDTWIN_REALTIME { return 0.0; }
};

/// Which hooks an effect overrides; found by the compiler (plant/effects/entry.h).
struct EffectHooks {
  bool join = false, tick = false, torque = false, take_torque = false, load = false, scale = false, advance = false,
       sense = false, counts = false, power = false, show = false, show_forces = false, take_forces = false;
};

}  // namespace feedtwin::plant
