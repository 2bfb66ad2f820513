#pragma once
// All effects of one axis, as the integrator's `Effects` and around it: torque in, forces of the sub-steps, sensors out.
//
// What acts on guide and load acts on the table, the rest on motor and screw. Without compliance or play both are one body;
// with either, the table is a second one (coupling.h). Every effect's work is kept, so that the energy balance stays closed.

#include <memory>
#include <optional>
#include <vector>

#include "plant/effects/coupling.h"
#include "plant/effects/entry.h"
#include "plant/energy.h"
#include "plant/integrator.h"

namespace feedtwin::plant {

/// The axis with the effects that are a number of it worked in. Throws std::invalid_argument on an unknown id or a setting
/// that does not fit its entry.
[[nodiscard]] AxisParameters adapted(const AxisParameters& parameters);

class EffectChain {
 public:
  /// Set-up. @param axis adapted; @param model of it. Throws as adapted() does.
  EffectChain(const AxisParameters& axis, const AxisModel<double>& model);

  /// True if there is anything to run in the tick.
  [[nodiscard]] bool empty() const noexcept { return links_.empty(); }
  [[nodiscard]] bool has_table() const noexcept { return coupling_.has_value(); }
  [[nodiscard]] bool remembers_forces() const noexcept { return !taking_forces_.empty(); }

  /// What the integrator moves: the model, less the motor's Coulomb friction where an effect is that, and without table,
  /// guide and end stops where the table is a second body.
  [[nodiscard]] AxisModel<double> driven(const AxisModel<double>& model) const noexcept;
  /// Sub-steps that the effects want at least; in a tick in which no flank changes.
  [[nodiscard]] Resolution at_least(Resolution resolution) const noexcept { return at_least(resolution, false); }
  [[nodiscard]] Resolution at_least_in_a_calm_tick(Resolution resolution) const noexcept;
  /// Once a tick.
  [[nodiscard]] bool calm(const AxisState<double>& state) noexcept FEEDTWIN_REALTIME {
    return coupling_ && coupling_->flank_bears(state.position_m);
  }

  /// Effects back to the start of a run; the work that they took stays in the account.
  void reset(double position_m, double velocity_m_per_s) noexcept;

  /// Start a tick; returns the motor's mean torque over it.
  [[nodiscard]] double start_tick(double torque_Nm, double cutting_force_N,
                                  const TickStart& start) noexcept FEEDTWIN_REALTIME;

  /// The motor's torque that this command would make, without taking it.
  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& start) const noexcept FEEDTWIN_REALTIME;

  // the integrator's hooks
  [[nodiscard]] ExtraLoad<double> before(const AxisState<double>& start,
                                         const Sliding<double>& predicted) noexcept FEEDTWIN_REALTIME;
  void after(const AxisState<double>& end, double mean_velocity_m_per_s, double h_s) noexcept FEEDTWIN_REALTIME;

  void sense(SensedTravel& travel) noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] std::int64_t counts(std::int64_t counts) noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] double power_W(TickPower power) noexcept FEEDTWIN_REALTIME;
  void show(AxisSignals& signals) noexcept FEEDTWIN_REALTIME;
  void show_forces(ForceSignals& forces) const noexcept FEEDTWIN_REALTIME;
  void take_forces(const ForceSignals& forces) noexcept FEEDTWIN_REALTIME;

  // work, in the loop of the tick: what effects took from the motor's torque; guide and stops of the table
  [[nodiscard]] double motor_torque_J() const noexcept { return motor_torque_J_; }
  [[nodiscard]] double guide_J() const noexcept { return coupling_ ? coupling_->guide_J() : 0.0; }
  [[nodiscard]] double stop_J() const noexcept { return coupling_ ? coupling_->stop_J() : 0.0; }

  [[nodiscard]] const Coupling& table() const noexcept { return *coupling_; }
  [[nodiscard]] double table_position_m(const AxisState<double>& state) const noexcept {
    return coupling_ ? coupling_->position_m() : state.position_m;
  }

  /// Forces on motor, screw and table at an instant, against positive motion; without inertia, cutting, nominal friction.
  struct Instant {
    double motor_N, screw_N, table_N;
    FrictionScale<double> scale;
  };
  [[nodiscard]] Instant instant(const AxisState<double>& state, double torque_Nm,
                                double cutting_force_N) const noexcept FEEDTWIN_REALTIME;

  /// Work that the effects took, by where it went.
  struct Work {
    double motor_J = 0.0, screw_J = 0.0, guide_J = 0.0, load_J = 0.0;  ///< by component
    double stored_J = 0.0, lost_J = 0.0;
    double magnitude_J = 0.0;  ///< sum of the magnitudes
  };
  [[nodiscard]] Work work(const AxisState<double>& state) const noexcept FEEDTWIN_REALTIME;

 private:
  struct Link {
    const EffectEntry* entry;
    std::unique_ptr<Effect> effect;
    bool at_table;
    EffectLoad load;  ///< of the last trial
    double work_J = 0.0;
  };
  [[nodiscard]] Resolution at_least(Resolution resolution, bool calm) const noexcept;
  [[nodiscard]] EffectMotion screw_motion(const AxisState<double>& state, const Sliding<double>& m,
                                          double torque_Nm) const noexcept;
  [[nodiscard]] EffectMotion table_motion(const EffectMotion& screw) const noexcept;
  [[nodiscard]] FrictionScale<double> scale_at(EffectMotion screw, EffectMotion table, double table_load_N) const noexcept;

  std::vector<Link> links_;
  std::vector<std::size_t> ticking_, torque_, screw_loads_, table_loads_, scaling_, advancing_, sensing_, counting_, power_,
      showing_, showing_forces_, taking_forces_;
  std::optional<Coupling> coupling_;
  double time_s_ = 0.0, tick_phase_s_ = 0.0, cutting_force_N_ = 0.0, torque_Nm_ = 0.0, magnitude_J_ = 0.0,
         motor_torque_J_ = 0.0;
  EffectMotion screw_{}, table_{};  ///< of the last trial
};

}  // namespace feedtwin::plant
