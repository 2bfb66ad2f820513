#pragma once
// The kernel's body. Everything that it calls is a template on the lane type, and each instruction set has a lane type of
// its own, so that no two of them can share a function.

#include "plant/axis_lanes.h"
#include "plant/force_sensors.h"
#include "plant/integrator.h"
#include "tools/identify/lanes/kernel.h"

namespace feedtwin::tools::lanes {

template <class Real>
struct LaneAxes {
  static constexpr std::size_t width = sizeof(Real) / sizeof(double);
  plant::AxisModel<Real> model;
  plant::AxisState<Real> state{};
  Real idle_W{}, linear_pos{}, linear_neg{}, quadratic_pos{}, quadratic_neg{}, position_offset_m{}, force_offset_N{};

  LaneAxes(const RecordView& record, const Candidate* candidates) noexcept {
    for (std::size_t i = 0; i < width; ++i) {
      const Candidate& c = candidates[i];
      plant::set_lane(model, i, c.model);
      idle_W[i] = c.idle_W;
      linear_pos[i] = c.linear_pos_Ws_per_m;
      linear_neg[i] = c.linear_neg_Ws_per_m;
      quadratic_pos[i] = c.quadratic_pos_Ws2_per_m2;
      quadratic_neg[i] = c.quadratic_neg_Ws2_per_m2;
      position_offset_m[i] = c.position_offset_m;
      force_offset_N[i] = c.force_offset_N;
      state.position_m[i] = record.position_m[0] + c.start_offset_m;
      state.velocity_m_per_s[i] = record.start_velocity_m_per_s;
    }
  }

  [[nodiscard]] Real electrical_J(const plant::AxisLosses<Real>& taken, double tick_s) const noexcept {
    return idle_W * tick_s + linear_pos * taken.travel_pos_m + linear_neg * taken.travel_neg_m +
           quadratic_pos * taken.speed_travel_pos_m2_per_s + quadratic_neg * taken.speed_travel_neg_m2_per_s;
  }
};

template <class Real>
inline void store(double* to, std::size_t at, const Real& values) noexcept {
  if (to != nullptr) __builtin_memcpy(to + at, &values, sizeof values);
}

/// The lanes with their controllers.
template <class Real>
struct LaneGroup {
  LaneAxes<Real> axis;
  StandIn<Real> stand_in;
  controllers::CascadeLaw<Real> cascade;

  LaneGroup(const RecordView& record, const Candidate* candidates) noexcept
      : axis(record, candidates), stand_in(record.stand_in, record.stand_in_mass_kg, record.tick_s), cascade(record.gains) {
    cascade.reset(record.position_m[0] - axis.position_offset_m);
  }

  [[nodiscard]] Real command_Nm(const RecordView& record, std::size_t i, const Real& shown_m) noexcept {
    if (record.reference != nullptr) return cascade.torque_Nm(record.reference[i], shown_m, record.tick_s);
    return record.torque_Nm[i] + stand_in.correction_N(record.position_m[i] - shown_m) / axis.model.transmission_rad_per_m;
  }

  /// @param metered power is wanted, and with it what each component takes: left out, the compiler leaves the sums out too
  template <bool metered>
  [[gnu::always_inline]] void step(const RecordView& record, std::size_t i, const Outputs& out) noexcept {
    const Real limit = Real{} + record.torque_limit_Nm;
    const Real shown_m = axis.state.position_m - axis.position_offset_m;
    const Real torque_Nm = command_Nm(record, i, shown_m);
    const Real applied_Nm = plant::smaller<Real>(plant::larger<Real>(torque_Nm, -limit), limit);
    const Real motor_N = applied_Nm * axis.model.transmission_rad_per_m;
    const Real drive_N = motor_N - axis.force_offset_N;
    const std::size_t at = i * out.stride;
    store<Real>(out.torque_Nm, at, torque_Nm);
    store<Real>(out.position_m, at, shown_m);
    if (out.torque_sensor_Nm != nullptr || out.force_sensor_N != nullptr) {
      const auto sensed = plant::sensed_forces<Real>(axis.model, axis.state, drive_N, Real{});
      store<Real>(out.torque_sensor_Nm, at, sensed.torque_sensor_Nm);
      store<Real>(out.force_sensor_N, at, sensed.force_sensor_N);
    }
    plant::NoEffects<Real> no_effects;
    [[maybe_unused]] const Real before_m = axis.state.position_m;
    [[maybe_unused]] const auto taken =
        plant::integrate_tick<Real>(axis.model, axis.state, no_effects, drive_N, record.tick_s, plant::one_count);
    if constexpr (metered) {
      const Real work_J = motor_N * (axis.state.position_m - before_m);
      const Real power_W = (axis.electrical_J(taken, record.tick_s) + work_J) / record.tick_s;
      store<Real>(out.power_W, at, power_W);
    }
  }
};

template <class Real, bool metered>
[[gnu::flatten]] void run_lanes(const RecordView& record, const Candidate* candidates, const Outputs& out) {
  LaneGroup<Real> lanes(record, candidates);
  for (std::size_t i = 0; i < record.samples; ++i) lanes.template step<metered>(record, i, out);
}

template <class Real>
void run_closed_loop(const RecordView& record, const Candidate* candidates, const Outputs& out) {
  out.power_W != nullptr ? run_lanes<Real, true>(record, candidates, out) : run_lanes<Real, false>(record, candidates, out);
}

}  // namespace feedtwin::tools::lanes
