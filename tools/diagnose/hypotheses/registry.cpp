#include "tools/diagnose/hypotheses/registry.h"

namespace feedtwin::tools::diagnosis {

std::vector<Hypothesis> registered() {
  return {
      cogging(),
      torque_ripple(),
      rev_ripple(),
      rev_ripple_of_friction(),
      backlash(),
      screw_compliance(),
      position_friction(),
      position_friction_wave(),
      copper_loss(),
      payload(),
      cable_spring(),
      current_loop_lag(),
      input_delay(),
      thermal_friction(),
      thermal_friction_of_all(),
      friction_drift(),
      torque_gain_error(),
      torque_offset(),
      gravity(),
      quadratic_drag(),
      sublinear_viscous(),
      direction_dependent_friction(),
      lead_error(),
      cyclic_lead_error(),
      encoder_eccentricity(),
      frictional_lag(),
      frictional_lag_of_velocity(),
      local_friction(),
      dwell_breakaway(),
      regeneration_clipped(),
      sensor_gain(),
      channel_skew(),
      torque_saturation(),
      floor_vibration(),
      hidden_friction_compensation(),
      process_force(),
      process_force_against_motion(),
      hard_stop(),
      count_loss(),
      screw_growth(),
      load_dependent_friction(),
      presliding_memory(),
  };
}

}  // namespace feedtwin::tools::diagnosis
