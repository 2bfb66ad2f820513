#pragma once
// The hypotheses, a file each; a new one is a file here, a line below and a line in registry.cpp.

#include "tools/diagnose/hypothesis.h"

namespace feedtwin::tools::diagnosis {

[[nodiscard]] Hypothesis cogging();
[[nodiscard]] Hypothesis torque_ripple();
[[nodiscard]] Hypothesis rev_ripple();
[[nodiscard]] Hypothesis rev_ripple_of_friction();
[[nodiscard]] Hypothesis backlash();
[[nodiscard]] Hypothesis screw_compliance();
[[nodiscard]] Hypothesis position_friction();
[[nodiscard]] Hypothesis position_friction_wave();
[[nodiscard]] Hypothesis copper_loss();
[[nodiscard]] Hypothesis payload();
[[nodiscard]] Hypothesis cable_spring();
[[nodiscard]] Hypothesis current_loop_lag();
[[nodiscard]] Hypothesis input_delay();
[[nodiscard]] Hypothesis thermal_friction();
[[nodiscard]] Hypothesis thermal_friction_of_all();
[[nodiscard]] Hypothesis friction_drift();
[[nodiscard]] Hypothesis torque_gain_error();
[[nodiscard]] Hypothesis torque_offset();
[[nodiscard]] Hypothesis gravity();
[[nodiscard]] Hypothesis quadratic_drag();
[[nodiscard]] Hypothesis sublinear_viscous();
[[nodiscard]] Hypothesis direction_dependent_friction();
[[nodiscard]] Hypothesis lead_error();
[[nodiscard]] Hypothesis cyclic_lead_error();
[[nodiscard]] Hypothesis encoder_eccentricity();
[[nodiscard]] Hypothesis frictional_lag();
[[nodiscard]] Hypothesis frictional_lag_of_velocity();
[[nodiscard]] Hypothesis local_friction();
[[nodiscard]] Hypothesis dwell_breakaway();
[[nodiscard]] Hypothesis regeneration_clipped();
[[nodiscard]] Hypothesis sensor_gain();
[[nodiscard]] Hypothesis channel_skew();
[[nodiscard]] Hypothesis torque_saturation();
[[nodiscard]] Hypothesis floor_vibration();
[[nodiscard]] Hypothesis hidden_friction_compensation();
[[nodiscard]] Hypothesis process_force();
[[nodiscard]] Hypothesis process_force_against_motion();
[[nodiscard]] Hypothesis hard_stop();
[[nodiscard]] Hypothesis count_loss();
[[nodiscard]] Hypothesis screw_growth();
[[nodiscard]] Hypothesis load_dependent_friction();
[[nodiscard]] Hypothesis presliding_memory();

[[nodiscard]] std::vector<Hypothesis> registered();

}  // namespace feedtwin::tools::diagnosis
